"""Prints the orders of campaigns, and exits 1 unless each study passes that leaves nothing out, and each other fails.

    python3 orders.py CAMPAIGN.json...
"""

import json
import sys


def orders(study):
    """Of each quantity the order that is expected of l2, the observed one, and the verdict."""
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
        sys.exit(f"{wrong} studies have another verdict than they should have")


main(sys.argv[1:])
