flat(value::Tuple) = reduce(vcat, map(flat, value))
flat(value) = [value]

function main()
    failures = 0
    defaults = field.Parameters()
    for (name, expected) in zip(fieldnames(field.Parameters), DEFAULTS[1])
        found = getfield(defaults, name)
        if !(abs(found - expected) <= eps() * abs(expected))
            println("default of $name: $found, not $expected")
            failures += 1
        end
    end
    for (place, T) in enumerate(PRECISIONS)
        fields = [field.prepare(field.Parameters{T}(values...)) for values in SETS]
        instants = [field.at_time(fields[s], T(row[1])) for (s, row) in zip(SET_OF, SAMPLES)]
        worst, worst_name = 0.0, "nothing"
        for (name, call, owner, columns, accepted, rows_expected) in FUNCTIONS
            errors, magnitudes = zeros(length(SETS)), zeros(length(SETS))
            for (row, expected) in enumerate(rows_expected)
                which = owner == :alone ? row : SET_OF[row]
                subject = owner == :now ? instants[row] : fields[which]
                inputs = owner == :alone ? T[] : T.(SAMPLES[row][columns])
                found = flat(call(subject, inputs...))
                @assert length(found) == length(expected) && all(isa.(found, T)) name
                for (value, wanted) in zip(found, expected)
                    error = isfinite(value) ? abs(Float64(value) - wanted) : Inf
                    errors[which] = max(errors[which], error)
                    magnitudes[which] = max(magnitudes[which], abs(wanted))
                end
            end
            least = Float64(floatmin(T))
            error = maximum(errors ./ max.(magnitudes, least)) / Float64(eps(T))
            if !(error <= accepted[place])
                println("$name in $T: $(round(error; sigdigits = 3)) eps, accepted $(accepted[place])")
                failures += 1
            end
            if error > worst
                worst, worst_name = error, name
            end
        end
        println("$NAME in $T: worst error $(round(worst; sigdigits = 3)) eps, of $worst_name")
    end
    exit(failures == 0 ? 0 : 1)
end

main()
