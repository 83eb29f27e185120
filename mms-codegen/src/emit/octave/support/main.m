
  f = field_();
  failures = 0;
  parameters = f.default_parameters();
  for k = 1:numel(names)
    difference = abs(parameters.(names{k}) - defaults(k));
    if ~(difference <= eps * abs(defaults(k)))
      fprintf('default of %s: %.17g, not %.17g\n', names{k}, parameters.(names{k}), defaults(k));
      failures = failures + 1;
    end
  end
  fields = cell(1, size(sets, 1));
  for k = 1:numel(fields)
    for n = 1:numel(names)
      parameters.(names{n}) = sets(k, n);
    end
    fields{k} = f.prepare(parameters);
  end
  now = cell(1, size(samples, 1));
  for k = 1:numel(now)
    now{k} = f.at_time(fields{set_of(k)}, samples(k, 1));
  end
  for p = 1:numel(precisions)
    precision = precisions{p};
    worst = 0;
    worst_name = 'nothing';
    for n = 1:size(functions, 1)
      [name, owner, columns, count, accepted] = functions{n, [1:4, 4 + p]};
      wanted = expected.(name);
      errors = zeros(1, numel(fields));
      magnitudes = errors;
      for k = 1:size(wanted, 1)
        if owner == 2
          found = f.(name)(fields{k});
          which = k;
        else
          which = set_of(k);
          subject = fields{which};
          if owner == 1
            subject = now{k};
          end
          found = at_arrays(f.(name), subject, cast(samples(k, columns), precision), count);
        end
        difference = abs(double(found) - wanted(k, :));
        difference(~isfinite(difference)) = Inf;
        errors(which) = max([errors(which), difference]);
        magnitudes(which) = max([magnitudes(which), abs(wanted(k, :))]);
      end
      most = max(errors ./ max(magnitudes, double(realmin(precision))) / double(eps(precision)));
      if ~(most <= accepted)
        fprintf('%s in %s precision: %.3g eps, accepted %d\n', name, precision, most, accepted);
        failures = failures + 1;
      end
      if most > worst
        worst = most;
        worst_name = name;
      end
    end
    fprintf('field_ in %s precision: worst error %.3g eps, of %s\n', precision, worst, worst_name);
  end
  if failures > 0
    error('field_: %d checks failed', failures);
  end
end
