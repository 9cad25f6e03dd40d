// Reads the report's data, which is part of the page.
"use strict";

/** The largest double stands for a distance divided by a bound of 0, because JSON has no infinity. */
const withInfinity = (value) => (Array.isArray(value) ? value.map(withInfinity) : value === Number.MAX_VALUE ? Infinity : value);
const report = JSON.parse(document.getElementById("report").textContent,
  (key, value) => (/over_bound$|^ratio$/.test(key) ? withInfinity(value) : value));

/** [{subject, kind, family, ...counts}]; family is "" for the sum over families. */
function countRows(byFamily) {
  const rows = [];
  for (const [subject, ofKind] of Object.entries(report.subjects))
    for (const [kind, counts] of Object.entries(ofKind)) {
      const families = byFamily ? counts.families : { "": counts };
      for (const [family, each] of Object.entries(families)) rows.push({ subject, kind, family, ...each });
    }
  return rows;
}
