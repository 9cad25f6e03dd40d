// Draws the share of ordinary collisions that each subject misses, against the subject's run time.
"use strict";

/** A row for each subject that was asked ordinary queries, with the sums over its kinds. */
function ordinaryRows() {
  return Object.entries(report.subjects).flatMap(([subject, kinds]) => {
    const ordinary = Object.values(kinds).map(({ classes }) => classes.ordinary).filter((each) => each !== undefined);
    const sum = (of, value) => of.reduce((total, each) => total + value(each), 0);
    const answered = ({ queries, faults }) => queries - Object.values(faults).reduce((total, each) => total + each, 0);
    const timed = ordinary.filter((each) => each.ns_per_query !== null);
    const collisions = sum(ordinary, (each) => each.collisions);
    const missed = sum(ordinary, (each) => each.false_negatives);
    const ns = sum(timed, (each) => answered(each) * each.ns_per_query) / sum(timed, answered);
    return collisions > 0 && ns > 0 ? [{ subject, collisions, missed, ns, share: missed / collisions }] : [];
  });
}

function drawMissesTime() {
  const rows = ordinaryRows();
  const size = [panelWidth(700), 340];
  const ns = rows.map((row) => row.ns);
  const x = { field: "ns", type: "quantitative", title: "ns a query",
    scale: { type: "log", nice: false, domain: [0.6 * Math.min(...ns), 1.7 * Math.max(...ns)] }, axis: { grid: true, tickCount: 6, format: "~s" } };
  const axis = logAxis(rows.map((row) => row.share), "format(datum.value, '~%')");
  const shown = rows.map((row) => ({ ...row, at: axis.at(row.share) }));
  const y = { field: "at", type: "quantitative", title: "ordinary collisions missed", scale: axis.scale, axis: axis.axis };
  const names = shown.map(({ subject, ns: from, at, missed }) => ({ subject, x: from, y: at, rank: missed === 0 ? 0 : 1 }));
  const tooltip = [{ field: "subject" }, { field: "missed" }, { field: "collisions" }, { field: "ns", title: "ns a query", ...digits(4) }];
  return draw("misses-time", "For each subject, the run time of an ordinary query, and the share of ordinary collisions that it misses.", {
    width: size[0], height: size[1], data: { values: shown },
    layer: [
      { mark: { type: "point", filled: true, size: 110, opacity: 0.9 }, encoding: { x, y, tooltip,
        color: { condition: { test: "datum.missed > 0", value: color("--bad") }, value: color("--good") } } },
      ...nameLayers(names, x, y, size),
    ],
  });
}
