function most = eps_between(found, expected, precision)
  % The largest error, in eps of the largest magnitude.
  difference = abs(double(found(:)) - expected(:));
  difference(~isfinite(difference)) = Inf;
  magnitude = max([abs(expected(:)); double(realmin(precision))]);
  most = max(difference) / magnitude / double(eps(precision));
end

function is = refused(name, most, accepted)
  % Whether an error is not accepted, which is printed.
  is = ~(most <= accepted);
  if is
    fprintf('%s: %.3g eps, accepted %d\n', name, most, accepted);
  end
end

function values = rows(text)
  % Lines of numbers, of 16 hexadecimal digits each.
  [count, width] = size(text);
  values = reshape(hex2num(reshape(text', 16, [])'), width / 16, count)';
end

function now = stacked(times)
  % What is known at each of some times, as columns.
  now = struct();
  names = fieldnames(times{1});
  for k = 1:numel(names)
    now.(names{k}) = cellfun(@(time) time.(names{k}), times);
  end
end

function found = at_arrays(evaluate, subject, inputs, count)
  % The components at arrays of other shapes, which make one of two rows and three columns.
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
