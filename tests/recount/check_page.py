"""Checks the data of a report's page, from which scripts draw everything."""

import json
import re


def check_page(comparison, where, page, json_report):
    """Checks that the data in the page equals report.json, with its entries in the same order."""
    found = re.search(r'<script[^>]*id="report"[^>]*>(.*?)</script>', page, re.DOTALL)
    data = json.loads(found[1])
    comparison.same('page', f'{where} sections', list(data), list(json_report))
    for name, value in json_report.items():
        is_same = json.dumps(data[name]) == json.dumps(value)
        comparison.same('page', f'{where} {name} is that of report.json', is_same, True)
