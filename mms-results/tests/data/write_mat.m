% Writes the files octave_*.mat beside it, with Octave: X on a grid, u = (0.1 X Y, -0.2 X), and what is no array of points.
[I, J] = meshgrid (0:2, 0:2);
X = [reshape(I', 9, 1) / 2, reshape(J', 9, 1) / 2];
u = [0.1 * X(:,1) .* X(:,2), -0.2 * X(:,1)];
time = 0.25;
s.v = 2 * u;
s.name = 'x';
words = 'not numbers';
save ('-v4', 'octave_4.mat', 'X', 'u', 'time', 'words');
save ('-v6', 'octave_6.mat', 'X', 'u', 'time', 's', 'words');
save ('-v7', 'octave_7.mat', 'X', 'u', 'time', 's', 'words');
