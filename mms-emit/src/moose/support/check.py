

def formulas():
    """Each formula of the file as a function of Python."""
    text = (pathlib.Path(__file__).parent / f"{FIELD}.i").read_text(encoding="utf-8")
    block = re.compile(r"^  \[(\w+)\]\n(.*?)^  \[\]$", re.MULTILINE | re.DOTALL)
    value = re.compile(r"^    (\w+) = '([^']*)'", re.MULTILINE)
    known = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
    known |= {"abs": abs, "cbrt": lambda x: math.copysign(abs(x) ** (1.0 / 3.0), x)}
    found = {}
    for name, body in block.findall(text):
        keys = dict(value.findall(body))
        *statements, result = keys["expression"].replace("^", "**").split(";")
        arguments = keys.get("symbol_names", "").split() + ["x", "y", "z", "t"]
        lines = [f"def formula({', '.join(arguments)}):"]
        lines += [f"    {statement.strip().replace(':=', '=')}" for statement in statements]
        scope = dict(known)
        exec("\n".join(lines + [f"    return {result.strip()}"]), scope)
        found[name] = scope["formula"], keys.get("symbol_values", "").split()
    defaults = dict(re.findall(rf"^{FIELD}_(\w+) = (\S+)$", text, re.MULTILINE))
    for name, default in defaults.items():
        assert float(default) == DEFAULTS[name], name
    return found


FORMULAS = formulas()


def evaluate(name, x=0.0, y=0.0, z=0.0, t=0.0, parameters={}):
    """The value of a function of the file, with the defaults of parameters that are not given."""
    parameters = DEFAULTS | parameters
    known = {f"${{{FIELD}_{parameter}}}": value for parameter, value in parameters.items()}

    def value(name):
        if name not in known:
            formula, symbols = FORMULAS[name]
            known[name] = formula(*map(value, symbols), x, y, z, t)
        return known[name]

    return float(value(f"{FIELD}_{name}"))


def main():
    for name in UNCHECKED:
        print(f"{name}: not checked, no digit of it is left")
    for tables in SETS:
        parameters = dict(zip(DEFAULTS, flat(tables["set"])))
        places = [dict(zip(AXES, point)) for point in tables["at"]]
        for name, is_of_points, suffixes, accepted in FUNCTIONS:
            found = [
                evaluate(name + suffix, **place, parameters=parameters)
                for place in (places if is_of_points else [{}])
                for suffix in suffixes
            ]
            check(name, accepted, tables[name], found)
    print(f"{FIELD}: worst error {worst:.3g} eps")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
