
for values, points, expected in zip(SETS, POINTS, EXPECTED):
    one = field.prepare(field.Parameters(*PARAMETERS))
    points = rows(points)
    now = INSTANTS
    for name, of, columns, accepted in FUNCTIONS:
        owners = {"domain": [one], "field": [one] * len(points), "now": now}[of]
        found = [CALL for owner, point in zip(owners, points or [[]])]
        check(name, accepted, rows(expected[name]), found)

print(f"field_: worst error {worst:.3g} eps")
sys.exit(1 if failures else 0)
