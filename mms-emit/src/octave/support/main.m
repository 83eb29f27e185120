
  f = feval('field_');
  worst = 0;
  failures = 0;
  parameters = f.default_parameters();
  for k = 1:numel(names)
    most = eps_between(parameters.(names{k}), defaults(k), 'double');
    failures = failures + refused(['default of ', names{k}], most, 1);
  end
  for s = 1:size(sets, 1)
    for n = 1:numel(names)
      parameters.(names{n}) = sets(s, n);
    end
    prepared = f.prepare(parameters);
    if isempty(points{s})
      continue
    end
    % All points at once, each at a time of its own; the first of them by itself, too.
    now = cell(size(points{s}, 1), 1);
    for k = 1:numel(now)
      now{k} = f.at_time(prepared, points{s}(k, 1));
    end
    of = struct('field', {{prepared, prepared}}, 'now', {{stacked(now), now{1}}});
    for p = 1:numel(precisions)
      precision = precisions{p};
      for n = 1:size(functions, 1)
        [name, owner, columns, count, accepted] = functions{n, [1:4, 4 + p]};
        wanted = expected.(name){s};
        if isempty(columns)
          found = repmat(f.(name)(prepared), size(wanted, 1), 1);
        else
          inputs = num2cell(cast(points{s}(:, columns), precision), 1);
          components = cell(1, count);
          [components{:}] = f.(name)(of.(owner){1}, inputs{:});
          found = [components{:}];
          first = cellfun(@(input) input(1), inputs);
          found(1, :) = at_arrays(f.(name), of.(owner){2}, first, count);
        end
        most = eps_between(found, wanted, precision);
        worst = max(worst, most);
        failures = failures + refused([name, ' in ', precision, ' precision'], most, accepted);
      end
    end
  end
  fprintf('field_: worst error %.3g eps\n', worst);
  if failures > 0
    error('field_: %d checks failed', failures);
  end
end
