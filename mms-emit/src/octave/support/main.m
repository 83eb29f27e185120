
  f = feval('field_');
  worst = 0;
  failures = 0;
  parameters = f.default_parameters();
  for k = 1:numel(names)
    most = eps_between(parameters.(names{k}), defaults(k), 'double');
    failures = failures + refused(['default of ', names{k}], most, 1);
  end
  for p = 1:numel(precisions)
    precision = precisions{p};
    for s = 1:size(sets, 1)
      for n = 1:numel(names)
        parameters.(names{n}) = sets(s, n);
      end
      prepared = f.prepare(parameters);
      of.field = repmat({prepared}, 1, size(points{s}, 1));
      of.now = of.field;
      for k = 1:numel(of.now)
        of.now{k} = f.at_time(prepared, points{s}(k, 1));
      end
      for n = 1:size(functions, 1)
        [name, owner, columns, count, accepted] = functions{n, [1:4, 4 + p]};
        wanted = expected.(name){s};
        found = zeros(size(wanted));
        for k = 1:size(wanted, 1)
          if isempty(columns)
            found(k, :) = f.(name)(prepared);
          else
            inputs = cast(points{s}(k, columns), precision);
            found(k, :) = at_arrays(f.(name), of.(owner){k}, inputs, count);
          end
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
