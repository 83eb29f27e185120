
for (name, found), expected in zip(vars(field.Parameters()).items(), FIRST["defaults"][0]):
    check(f"default of {name}", 1, expected, float(found))

for tables in SETS:
    [values], points = tables["set"], tables["at"]
    one = field.prepare(field.Parameters(*PARAMETERS))
    now = INSTANTS
    for table, name, of, columns, accepted in FUNCTIONS:
        owners = {"domain": [one], "field": [one] * len(points), "now": now}[of]
        calls = zip(owners, points or [[]])
        found = [CALL for owner, point in calls]
        check(table, accepted, tables[table], found)

print(f"field_: worst error {worst:.3g} eps")
sys.exit(1 if failures else 0)
