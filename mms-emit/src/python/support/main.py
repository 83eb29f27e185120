
for values, points, expected in zip(SETS, POINTS, EXPECTED):
    one = field.prepare(field.Parameters(*PARAMETERS))
    points = rows(points)
    now = INSTANTS
    for name, of, columns, accepted in FUNCTIONS:
        owners = {"domain": [one], "field": [one] * len(points), "now": now}[of]
        calls = zip(owners, points or [[]])
        found = [CALL for owner, point in calls]
        check(name, accepted, rows(expected[name]), found)

print(f"field_: worst error {worst:.3g} eps")
sys.exit(1 if failures else 0)
