  f = feval('field_');
  worst = 0;
  failures = 0;
  file = fopen(fullfile(fileparts(mfilename('fullpath')), 'field__vectors.txt'));
  parameters = f.default_parameters();
  [defaults, accepted] = table_of(file, 'defaults');
  for k = 1:numel(names)
    most = eps_between(parameters.(names{k}), defaults(k), 'double');
    failures = failures + refused(['default of ', names{k}], most, accepted(1));
  end
  for s = 1:sets
    values = table_of(file, 'set');
    for n = 1:numel(names)
      parameters.(names{n}) = values(n);
    end
    prepared = f.prepare(parameters);
    points = table_of(file, 'at');
    % All points at once, each at its own time; also the first of them alone.
    now = cell(size(points, 1), 1);
    for k = 1:numel(now)
      now{k} = f.at_time(prepared, points(k, 1));
    end
    for n = 1:size(functions, 1) * ~isempty(now)
      [name, called, owner, columns] = functions{n, :};
      [wanted, accepted] = table_of(file, name);
      for p = 1:numel(precisions)
        precision = precisions{p};
        if isempty(columns)
          found = repmat(f.(called)(prepared), size(wanted, 1), 1);
        else
          of = struct('field', {{prepared, prepared}}, 'now', {{stacked(now), now{1}}});
          inputs = num2cell(cast(points(:, columns), precision), 1);
          components = cell(1, size(wanted, 2));
          [components{:}] = f.(called)(of.(owner){1}, inputs{:});
          found = [components{:}];
          first = cellfun(@(input) input(1), inputs);
          found(1, :) = at_arrays(f.(called), of.(owner){2}, first, numel(components));
        end
        most = eps_between(found, wanted, precision);
        worst = max(worst, most);
        failures = failures + refused([name, ' in ', precision, ' precision'], most, accepted(p));
      end
    end
  end
  fclose(file);
  fprintf('field_: worst error %.3g eps\n', worst);
  if failures > 0
    error('field_: %d checks failed', failures);
  end
end

function most = eps_between(found, expected, precision)
  % The largest error, in eps of the largest magnitude.
  difference = abs(double(found(:)) - expected(:));
  difference(~isfinite(difference)) = Inf;
  magnitude = max([abs(expected(:)); double(realmin(precision))]);
  most = max(difference) / magnitude / double(eps(precision));
end

function is = refused(name, most, accepted)
  % Whether an error is too large; prints it in that case.
  is = ~(most <= accepted);
  if is
    fprintf('%s: %.3g eps, accepted %d\n', name, most, accepted);
  end
end

function [values, accepted] = table_of(file, name)
  % The next table of the test vectors with a name: its numbers, and the accepted errors.
  line = '';
  while ~strncmp(line, [name, ' '], numel(name) + 1)
    line = fgetl(file);
    if ~ischar(line)
      error('field__vectors.txt has no table %s: emit it anew', name);
    end
  end
  head = sscanf(line(numel(name) + 1:end), '%f')';
  values = zeros(head(1:2));
  for row = 1:head(1) * (head(2) > 0)
    values(row, :) = sscanf(fgetl(file), '%f');
  end
  accepted = head(3:4);
end

function now = stacked(times)
  % The field at several times; its values are columns.
  now = struct();
  names = fieldnames(times{1});
  for k = 1:numel(names)
    now.(names{k}) = cellfun(@(time) time.(names{k}), times);
  end
end

function found = at_arrays(evaluate, subject, inputs, count)
  % The components at arrays of other shapes, which broadcast to two rows and three columns.
  shapes = {[2, 1], [1, 3], [2, 3]};
  arrays = cell(1, numel(inputs));
  for k = 1:numel(inputs)
    arrays{k} = repmat(inputs(k), shapes{mod(k - 1, 3) + 1});
  end
  components = cell(1, count);
  [components{:}] = evaluate(subject, arrays{:});
  found = zeros(1, count, class(inputs));
  for k = 1:count
    first = components{k}(1);
    if ~isequaln(components{k}, repmat(first, size(components{k}))) || ~isa(first, class(inputs))
      error('a component is not the same at the same points, or of another precision');
    end
    found(k) = first;
  end
end
