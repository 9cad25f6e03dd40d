// Draws how misses, false positives, earliness and run time depend on the value of a subject's option.
"use strict";

/**
 * For each chart of an option: the field that the chart shows, the chart's title, and the format of the
 * chart's numbers. Without a format, the chart has the usual format of logAxis.
 */
const optionCharts = [
  ["false_negative_rate", "missed, among collisions", "share(datum.value)"],
  ["late_rate", "late, among promised times", "share(datum.value)"],
  ["false_positive_rate", "false positives, among non-collisions", "share(datum.value)"],
  ["early", "early, 99 % at most"],
  ["ns_per_query", "ns a query"],
];

/** The steps of each sweep of an option, with the numbers that the charts show. */
const optionSteps = () => Object.entries(report.option_sweeps).map(([pattern, steps]) => [pattern, steps.map((step) => ({ ...step,
  late_rate: step.times_promised > 0 ? step.late / step.times_promised : null, early: step.time_sort === "none" ? null : step.q99_early[1] }))]);

function drawOptions() {
  element("cliffs").replaceChildren(...(report.cliffs ?? []).map(({ pattern, text }) => made("li", `${pattern}: ${text}.`)));
  const sweeps = optionSteps();
  const classes = classNames.filter((name) => sweeps.some(([, steps]) => steps.some((step) => step.class === name)));
  const shown = optionCharts.filter(([field]) => sweeps.some(([, steps]) => steps.some((step) => step[field] > 0)));
  const hue = { field: "class", type: "nominal", title: "class of families", scale: { domain: classes, range: palette } };
  const tooltip = [{ field: "value" }, { field: "class" }, { field: "queries" }, { field: "collisions" }, { field: "false_negatives", title: "missed" },
    { field: "late" }, { field: "false_positives", title: "false positives" }, { field: "without_answer", title: "without an answer" },
    { field: "ns_per_query", title: "ns a query", ...digits(4) }];
  const panel = (steps) => ([field, title, written]) => {
    const known = steps.filter((step) => step[field] !== null);
    const [across, up] = [logAxis(steps.map((step) => step.value)), logAxis(known.map((step) => step[field]), written)];
    const rows = known.map((step) => ({ ...step, across: across.at(step.value), up: up.at(step[field]) }));
    return {
      title, width: Math.max(200, Math.min(300, (element("how").clientWidth - 80 * shown.length) / shown.length)), height: 200, data: { values: rows },
      mark: { type: "line", point: { filled: true, size: 50 } },
      encoding: {
        x: { field: "across", type: "quantitative", title: "value", scale: across.scale, axis: across.axis },
        y: { field: "up", type: "quantitative", title: null, scale: up.scale, axis: up.axis },
        color: hue, tooltip,
      },
    };
  };
  return draw("options", "For each value of an option, the rates of misses and of false positives, and the run time.", {
    vconcat: sweeps.map(([pattern, steps]) => ({ title: { text: pattern, anchor: "start", offset: 12 }, hconcat: shown.map(panel(steps)) })),
  });
}
