"""Checks the data of a report's page, from which scripts draw everything."""

import json
import re


def check_page(comparison, where, page, json_report):
    """Checks that the data in the page equals report.json."""
    data = re.search(r'<script[^>]*id="report"[^>]*>(.*?)</script>', page, re.DOTALL)
    comparison.same('page', f'{where} data', json.loads(data[1]) == json_report, True)
