flat(value::Union{Tuple,Vector}) = reduce(vcat, map(flat, value))
flat(value) = [value]

const WORST, FAILURES = Ref(0.0), Ref(0)

"Compares what a function gives with a set of parameters."
function check(name, T, accepted, expected, found)
    expected, found = flat(expected), flat(found)
    @assert length(found) == length(expected) && all(isa.(found, T)) name
    difference = [isfinite(a) ? abs(Float64(a) - b) : Inf for (a, b) in zip(found, expected)]
    magnitude = max(maximum(abs, expected), Float64(floatmin(T)))
    error = maximum(difference) / magnitude / Float64(eps(T))
    WORST[] = max(WORST[], error)
    if !(error <= accepted)
        println("$name in $T: $(round(error; sigdigits = 3)) eps, accepted $accepted")
        FAILURES[] += 1
    end
end

function main()
    defaults = field.Parameters()
    for (name, expected) in zip(fieldnames(field.Parameters), DEFAULTS[1])
        check("default of $name", Float64, 1, expected, getfield(defaults, name))
    end
    for (place, T) in enumerate(PRECISIONS), s in eachindex(SETS)
        one = field.prepare(field.Parameters{T}(SETS[s]...))
        now = [field.at_time(one, T(point[1])) for point in POINTS[s]]
        for (name, call, owner, columns, accepted, expected) in FUNCTIONS
            owners = owner == :now ? now : fill(one, length(expected[s]))
            points = owner == :alone ? [Float64[]] : POINTS[s]
            found = [call(it, T.(point[columns])...) for (it, point) in zip(owners, points)]
            check(name, T, accepted[place], expected[s], found)
        end
    end
    println("$NAME: worst error $(round(WORST[]; sigdigits = 3)) eps")
    exit(FAILURES[] == 0 ? 0 : 1)
end

main()
