"""Prints the orders of campaigns. Exits 1 unless each study with all terms passes, and each other study fails.

    python3 orders.py CAMPAIGN.json...
"""

import json
import sys


def orders(study):
    """For each quantity its name, the expected and observed orders of l2, and the verdict."""
    for quantity in study["judgement"]["quantities"]:
        norm = next(it for it in quantity["norms"] if it["norm"] == "l2")
        yield quantity["name"], norm["expected_order"], norm["observed_order"], quantity["verdict"]


def main(paths):
    wrong = 0
    print(f"{'solver':7} {'study':24} {'quantity':13} expected observed  verdict")
    for path in paths:
        with open(path) as file:
            campaign = json.load(file)
        for study in campaign["studies"]:
            leaves_out = study["name"].startswith("without ")
            wrong += study["verdict"] != ("fail" if leaves_out else "pass")
            for name, expected, observed, verdict in orders(study):
                solver = path.rsplit("/", 2)[-2]
                print(f"{solver:7} {study['name']:24} {name:13} {expected:8.0f} {observed:8.2f}  {verdict}")
    if wrong:
        sys.exit(f"{wrong} studies do not have the expected verdict")


main(sys.argv[1:])
