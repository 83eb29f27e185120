

# Variables for the numbers of a point in expressions.
LEAVES = [ufl.variable(ufl.as_ufl(1.0)) for _ in (SETS[0]["at"] or [[]])[0]]
OPERATIONS = {
    "Sum": lambda a, b: a + b,
    "Product": lambda a, b: a * b,
    "Division": lambda a, b: a / b,
    "Power": lambda a, b: a**b,
    "Sqrt": math.sqrt,
    "Exp": math.exp,
    "Ln": math.log,
    "Sin": math.sin,
    "Cos": math.cos,
    "Tan": math.tan,
    "Sinh": math.sinh,
    "Cosh": math.cosh,
    "Tanh": math.tanh,
    "Asin": math.asin,
    "Acos": math.acos,
    "Atan": math.atan,
    "Atan2": math.atan2,
}


@functools.cache
def expression(owner, name, *columns):
    """The result of a function of leaves."""
    return getattr(owner, name)(*(LEAVES[column] for column in columns))


def evaluated(expression, point):
    """The components of an expression; each node is computed once, in double precision."""
    values = dict(zip(LEAVES, point))
    for node in unique_post_traversal(expression):
        kind = type(node).__name__
        if node in values or kind in ("MultiIndex", "Label"):
            continue
        if kind in OPERATIONS:
            values[node] = OPERATIONS[kind](*(values[operand] for operand in node.ufl_operands))
        elif kind == "ListTensor":
            values[node] = [values[operand] for operand in node.ufl_operands]
        elif kind == "Zero" and node.ufl_shape:
            values[node] = [0.0] * math.prod(node.ufl_shape)
        else:
            values[node] = float(node)
    return [float(number) for number in flat(values[expression])]


