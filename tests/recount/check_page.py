"""Checks the data of a report's page, from which scripts draw everything."""

import html.parser
import json


class _Data(html.parser.HTMLParser):
    """Collects the JSON in a page."""

    def __init__(self):
        super().__init__()
        self._inside, self.text = False, ''

    def handle_starttag(self, tag, attrs):
        self._inside = tag == 'script' and dict(attrs).get('id') == 'report'

    def handle_endtag(self, tag):
        self._inside = False

    def handle_data(self, data):
        if self._inside:
            self.text += data


def check_page(comparison, where, page, json_report):
    """Checks that the data in the page equals report.json, value by value."""
    data = _Data()
    data.feed(page)
    _check_same(comparison, where, json.loads(data.text), json_report)


def _check_same(comparison, where, found, expected):
    if isinstance(expected, (dict, list)) and type(found) is type(expected):
        own = expected.items() if isinstance(expected, dict) else enumerate(expected)
        shape = (lambda value: list(value)) if isinstance(expected, dict) else len
        comparison.same('page', f'{where} entries', shape(found), shape(expected))
        for key, value in own:
            inside = (
                isinstance(found, dict)
                and key in found
                or isinstance(found, list)
                and key < len(found)
            )
            if inside:
                _check_same(comparison, f'{where}.{key}', found[key], value)
    else:
        comparison.same('page', where, found, expected)
