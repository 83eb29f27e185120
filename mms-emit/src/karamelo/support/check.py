

def single(value):
    """The nearest number of single precision."""
    return ctypes.c_float(value).value


def calculation():
    """All variables of the file as one function of Python, rounded as they are computed."""
    text = (pathlib.Path(__file__).parent / f"{FIELD}.kar").read_text(encoding="utf-8")
    lines = ["def calculation(x0, y0, z0, time, parameters):", "    PI = single(math.pi)"]
    number = re.compile(r"(?<![\w.])\d+(\.\d+)?")
    for line in text.splitlines():
        name, _, formula = line.partition("#")[0].partition(" = ")
        parameter = name[len(FIELD) + 1 :]
        if parameter in DEFAULTS and name == f"{FIELD}_{parameter}":
            assert float(formula) == DEFAULTS[parameter], parameter
            lines.append(f"    {name} = single(parameters[{parameter!r}])")
        elif formula:
            formula = number.sub(r"single(\g<0>)", formula)
            lines.append(f"    {name} = single({formula})")
    scope = {name: getattr(math, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "atan2")}
    scope |= {"math": math, "single": single}
    exec("\n".join(lines + ["    return locals()"]), scope)
    return scope["calculation"]


CALCULATION = calculation()


def variables(x=0.0, y=0.0, z=0.0, t=0.0, parameters={}):
    """All variables of the file, with the defaults of parameters that are not given."""
    return CALCULATION(x, y, z, t, DEFAULTS | parameters)


def main():
    for name in UNCHECKED:
        print(f"{name}: not checked, no digit of it is left")
    for tables in SETS:
        parameters = dict(zip(DEFAULTS, flat(tables["set"])))
        places = [dict(zip(AXES, point)) for point in tables["at"]] or [{}]
        placed = [variables(**place, parameters=parameters) for place in places]
        for name, is_of_points, suffixes, accepted in FUNCTIONS:
            all_found = placed if is_of_points else placed[:1]
            found = [one[f"{FIELD}_{name}{suffix}"] for one in all_found for suffix in suffixes]
            check(name, accepted, tables[name], found)
    print(f"{FIELD}: worst error {worst:.3g} eps")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
