flat(value::Union{Tuple,Vector}) = reduce(vcat, map(flat, value))
flat(value) = [value]

"A table of the test vectors: the errors that are accepted in both precisions, and rows."
struct Table
    accepted::Vector{Int}
    rows::Vector{Vector{Float64}}
end

"The test vectors: the defaults of the parameters, and the tables of each set of parameters."
function vectors()
    lines = readlines(joinpath(@__DIR__, "$(NAME)_vectors.txt"))
    sets, at = [Dict{String,Table}()], 1
    while at <= length(lines)
        name, sizes... = split(lines[at])
        if name != "#"
            rows, _, accepted... = parse.(Int, sizes)
            name == "set" && push!(sets, Dict{String,Table}())
            numbers = [parse.(Float64, split(line)) for line in lines[at+1:at+rows]]
            sets[end][name] = Table(accepted, numbers)
            at += rows
        end
        at += 1
    end
    @assert length(sets) == 1 + SETS "the test vectors are not whole: emit them anew"
    return sets[1]["defaults"].rows[1], sets[2:end]
end

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
    expected_defaults, sets = vectors()
    defaults = field.Parameters()
    for (name, expected) in zip(fieldnames(field.Parameters), expected_defaults)
        check("default of $name", Float64, 1, expected, getfield(defaults, name))
    end
    for (place, T) in enumerate(PRECISIONS), tables in sets
        one = field.prepare(field.Parameters{T}(tables["set"].rows[1]...))
        points = tables["at"].rows
        now = [field.at_time(one, T(point[1])) for point in points]
        for (name, call, owner, columns) in FUNCTIONS
            expected = tables[name]
            owners = owner == :now ? now : fill(one, length(expected.rows))
            inputs = owner == :alone ? [Float64[]] : points
            found = [call(it, T.(point[columns])...) for (it, point) in zip(owners, inputs)]
            check(name, T, expected.accepted[place], expected.rows, found)
        end
    end
    println("$NAME: worst error $(round(WORST[]; sigdigits = 3)) eps")
    exit(FAILURES[] == 0 ? 0 : 1)
end

main()
