// Draws error against run time: a mark for each subject, or lines if an algorithm has at least three scalars.
"use strict";

const errorTimeTooltip = [{ field: "subject" }, { field: "ns_per_query", title: "ns a query", ...digits(4) },
  { field: "false_negatives", title: "missed" }, { field: "collisions", title: "collisions" },
  { field: "false_positive_rate", title: "false positives", ...asShare }];

function drawErrorTime() {
  const { left_out, ladder } = report.error_against_time;
  if (left_out.length > 0) {
    element("error-time-others").textContent = `Not shown, because they were asked about other families: ${left_out.join(", ")}.`;
    show("error-time-others");
  }
  return ladder ? drawErrorTimeOfLadder() : drawErrorTimeOfEach();
}

/**
 * The position of a value on a logarithmic axis: 0 at one end, 1 at the other. Takes the logarithms of both
 * ends separately, because the ratio of the ends may overflow.
 */
const partOfAxis = (value, [from, to]) => (Math.log(value) - Math.log(from)) / (Math.log(to) - Math.log(from));
const atPartOfAxis = (part, [from, to]) => Math.exp((1 - part) * Math.log(from) + part * Math.log(to));

/**
 * Layers that write the names of points into a chart with logarithmic axes. A line joins a point to its name
 * unless the name is right beside the point.
 * @param rows [{subject, x, y, rank}]
 * @param x, y the chart's channels in Vega-Lite
 */
function nameLayers(rows, x, y, [width, height]) {
  const [xs, ys] = [x.scale.domain, y.scale.domain];
  const points = rows.map((row) => ({ ...row, label: row.subject, at: [width * partOfAxis(row.x, xs), height * (1 - partOfAxis(row.y, ys))] }));
  const names = placedLabels(points, [width, height], 120).map(({ place: [px, py], ...row }) =>
    ({ ...row, nameX: atPartOfAxis(px / width, xs), nameY: atPartOfAxis(1 - py / height, ys) }));
  const text = (mark) => ({ data: { values: names }, mark: { type: "text", fontSize: labelSize, ...mark },
    encoding: { x: { ...x, field: "nameX" }, y: { ...y, field: "nameY" }, text: { field: "subject" } } });
  const lines = { data: { values: names.filter(({ isFar }) => isFar) }, mark: { type: "rule", color: color("--soft"), strokeWidth: 0.6 },
    encoding: { x: { ...x, field: "x" }, y: { ...y, field: "y" }, x2: { field: "nameX" }, y2: { field: "nameY" } } };
  return [lines, text({ stroke: color("--paper"), strokeWidth: 3 }), text({ color: color("--ink") })];
}

/**
 * Draws a mark with a name for each subject. Only the subjects chosen in the picker have their own colours.
 */
function drawErrorTimeOfEach() {
  const { subjects, front_by_distance, front_by_rate } = report.error_against_time;
  const rows = Object.entries(subjects).map(([subject, each]) => ({ subject, ...each,
    median: each.median_fp_distance_over_bound[1], q99: each.q99_fp_distance_over_bound[1] }))
    .sort((a, b) => isChosen(a) - isChosen(b));
  const hue = chosenColor(color("--soft"));
  const times = rows.map((row) => row.ns_per_query);
  const ends = [0.6 * Math.min(...times), 1.7 * Math.max(...times)];
  const size = [panelWidth(700), 320];
  const x = { field: "ns_per_query", type: "quantitative", title: "ns a query",
    scale: { type: "log", nice: false, domain: ends }, axis: { grid: true, tickCount: 6, format: "~s" } };
  const tooltip = [...errorTimeTooltip,
    { field: "median", title: "median distance / bound, at most", ...digits(3) },
    { field: "q99", title: "99 %, at most", ...digits(3) },
    { field: "max_fp_distance_over_bound", title: "largest", ...digits(5) }, boundField];
  const panel = (title, top, marks, front) => {
    const axis = logAxis(rows.flatMap((row) => [top, ...marks].map((field) => row[field])));
    const shown = rows.map((row) => {
      const at = { ...row, top: axis.at(row[top]) };
      marks.forEach((field, i) => (at[`mark${i}`] = axis.at(row[field])));
      return at;
    });
    const y = (field) => ({ field, type: "quantitative", title: null, scale: axis.scale, axis: axis.axis });
    const own = { x, color: hue, tooltip };
    const names = shown.map((row) => ({ subject: row.subject, x: row.ns_per_query, y: row.top, rank: row.sound ? 0 : 1 }));
    return {
      width: size[0], height: size[1], title, data: { values: shown },
      layer: [
        ...(front.length === 0 ? [] : [{ transform: [{ filter: { field: "subject", oneOf: front } }],
          mark: { type: "line", interpolate: "step-after", strokeDash: [5, 4], color: color("--soft") }, encoding: { x, y: y("top") } }]),
        ...(marks.length === 0 ? [] : [
          { mark: { type: "rule", strokeWidth: 2 }, encoding: { ...own, y: y("mark0"), y2: { field: "top" } } },
          ...marks.map((_, i) => ({ mark: { type: "tick", orient: "horizontal", thickness: 2, width: i === 0 ? 8 : 14 },
            encoding: { ...own, y: y(`mark${i}`) } }))]),
        { mark: { type: "point", filled: true, size: 130, opacity: 0.9 }, encoding: { ...own, y: y("top") } },
        ...(rows.every((row) => row.sound) ? [] : [{ transform: [{ filter: "!datum.sound" }],
          mark: { type: "point", shape: "cross", angle: 45, size: 60, filled: true, opacity: 1, color: color("--bad"), stroke: color("--paper"), strokeWidth: 0.7 },
          encoding: { x, y: y("top"), tooltip } }]),
        ...nameLayers(names, x, y("top"), size),
      ],
    };
  };
  return draw("error-time", "For each subject, the run time of a query, and the distances and the rate of its false positives.", {
    hconcat: [
      panel("farthest false positive / bound", "max_fp_distance_over_bound", ["median", "q99"], front_by_distance),
      panel("false positives, among non-collisions", "false_positive_rate", [], front_by_rate),
    ],
  });
}

const labelSize = 10;
const isEmulated = (row) => /^p\d/.test(row.scalar);

/**
 * Divides points into lines, and orders the points of each line by the number of digits of their scalars. An
 * algorithm has one line for scalars of the machine, and one line for emulated scalars.
 */
function makeStrands(rows) {
  const strands = new Map();
  for (const row of rows) {
    row.strand = row.algorithm + (isEmulated(row) ? " p" : "");
    strands.set(row.strand, [...(strands.get(row.strand) ?? []), row]);
  }
  for (const strand of strands.values()) {
    strand.sort((a, b) => b.epsilon - a.epsilon);
    strand.forEach((row, i) => Object.assign(row, { step: i, isEnd: i === 0 || i === strand.length - 1, isFew: i % 3 === 0 }));
  }
}

/**
 * Places for a label of this size, relative to the label's point, in the order in which they are tried: first
 * beside the point, then at growing distances of up to `reach` pixels.
 */
function* placesAround([w, h], reach) {
  yield* [[6, -h / 2], [-6 - w, -h / 2], [-w / 2, -6 - h], [-w / 2, 6], [5, -4 - h], [5, 4], [-5 - w, -4 - h], [-5 - w, 4]];
  for (let radius = 22; radius <= reach; radius += 8)
    for (let i = 0; i < 16; ++i) {
      const [dx, dy] = [Math.cos((i * Math.PI) / 8), Math.sin((i * Math.PI) / 8)];
      yield [radius * dx + (dx < 0 ? -w : 0), radius * dy - h / 2];
    }
}

/**
 * Finds places for labels near their points, so that no label covers another label or a point. Leaves out a
 * label for which no place is free.
 * @param points [{at: [x, y] in pixels, label, rank: lower ranks choose first; an infinite rank means no
 * label}]
 * @param reach how far from its point a label may be, in pixels; 0 means right beside it
 */
function placedLabels(points, [width, height], reach = 0) {
  const pen = made("canvas").getContext("2d");
  pen.font = `${labelSize}px ${look.font}`;
  const taken = points.map(({ at: [x, y] }) => [x - 4, y - 4, x + 4, y + 4]);
  const isFree = (box) => box[0] >= 0 && box[1] >= 0 && box[2] <= width && box[3] <= height &&
    taken.every((other) => box[0] >= other[2] || box[2] <= other[0] || box[1] >= other[3] || box[3] <= other[1]);
  const placed = [];
  for (const point of points.filter(({ rank }) => rank < Infinity).sort((a, b) => a.rank - b.rank)) {
    const [x, y] = point.at;
    const [w, h] = [pen.measureText(point.label).width + 2, labelSize + 1];
    for (const [dx, dy] of placesAround([w, h], reach)) {
      const box = [x + dx, y + dy, x + dx + w, y + dy + h];
      if (!isFree(box)) continue;
      taken.push(box);
      const isFar = Math.hypot(Math.max(dx, 0, -dx - w), Math.max(dy, 0, -dy - h)) > 12;
      placed.push({ ...point, isFar, place: [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2] });
      break;
    }
  }
  return placed;
}

/** Draws lines (makeStrands), and writes the names of scalars beside some of the points. */
function drawErrorTimeOfLadder() {
  const { subjects, ladder, front_by_rate } = report.error_against_time;
  const rows = Object.entries(subjects).map(([subject, each]) => ({ subject, ...each }));
  for (const id of ["error-time-of-each", "error-time-of-ladder"]) element(id).toggleAttribute("hidden");
  makeStrands(rows);
  const isAlone = ({ algorithm }) => rows.filter((row) => row.algorithm === algorithm).length === 1;
  const times = rows.map((row) => row.ns_per_query);
  const [shortest, longest] = [0.7 * Math.min(...times), 1.4 * Math.max(...times)];
  const x = { field: "ns_per_query", type: "quantitative", title: "ns a query",
    scale: { type: "log", nice: false, domain: [shortest, longest] }, axis: { grid: true, tickCount: 6, format: "~s" } };
  const hue = { ...algorithmColor([...new Set(rows.map((row) => row.algorithm))]), legend: { symbolOpacity: 1 } };
  const opacity = (most) => ({ condition: { param: "chosen", value: most }, value: 0.1 });
  const tooltip = [...errorTimeTooltip, { field: "epsilon", title: "ε", ...digits(3) },
    { field: "farthest_over_B", title: "farthest / B", ...digits(4) },
    { field: "max_fp_distance_over_bound", title: "farthest / bound", ...digits(5) }, boundField];
  const [width, height] = [panelWidth(460), 360];
  const panel = (title, field, front, bounds, params) => {
    const known = rows.filter((row) => row[field] !== null);
    const axis = logAxis([...known.map((row) => row[field]), ...bounds]);
    const shown = known.map((row) => ({ ...row, y: axis.at(row[field]), isFront: front.includes(row.subject) }));
    const y = { field: "y", type: "quantitative", title: null, scale: axis.scale, axis: axis.axis };
    const labels = placedLabels(shown.map((row) => ({ ...row, label: isAlone(row) ? row.algorithm : row.scalar,
      ink: mixed(colorOfAlgorithm(row.algorithm), color("--ink")),
      rank: row.isFront ? 0 : !isEmulated(row) ? 1 : row.isEnd ? 2 : row.isFew ? 3 : Infinity,
      at: [width * partOfAxis(row.ns_per_query, [shortest, longest]), height * (1 - partOfAxis(row.y, axis.scale.domain))] })), [width, height])
      .map(({ place: [px, py], ...row }) => ({ ...row, ns_per_query: atPartOfAxis(px / width, [shortest, longest]),
        y: atPartOfAxis(1 - py / height, axis.scale.domain) }));
    const text = (ofFront, mark, encoding) => ({ data: { values: labels.filter((row) => row.isFront === ofFront) },
      mark: { type: "text", fontSize: labelSize, fontWeight: ofFront ? "bold" : "normal", ...mark },
      encoding: { x, y, text: { field: "label" }, opacity: opacity(1), ...encoding } });
    const texts = (ofFront) => [text(ofFront, { stroke: color("--paper"), strokeWidth: 3 }, {}),
      text(ofFront, {}, { color: { field: "ink", type: "nominal", scale: null } })];
    const points = (values, size, params = []) => ({ params, data: { values },
      mark: { type: "point", filled: true, size }, encoding: { x, y, color: hue, tooltip, opacity: opacity(1) } });
    return {
      width, height, title, data: { values: shown },
      layer: [
        ...bounds.map((bound) => ({ data: { values: [{ y: bound }] }, mark: { type: "rule", color: color("--bad"), strokeWidth: 2 }, encoding: { y } })),
        { data: { values: shown.filter((row) => row.isFront) },
          mark: { type: "line", interpolate: "step-after", strokeDash: [5, 4], color: color("--soft") }, encoding: { x, y } },
        { mark: { type: "line", strokeWidth: 1.5 },
          encoding: { x, y, color: hue, detail: { field: "strand" }, order: { field: "step", type: "quantitative" }, opacity: opacity(isDark ? 0.8 : 0.5) } },
        points(shown.filter(isEmulated), 26), points(shown.filter((row) => !isEmulated(row)), 80, params),
        { data: { values: shown.filter((row) => row.false_negatives > 0) },
          mark: { type: "point", shape: "cross", angle: 45, size: 40, filled: true, color: color("--bad"), stroke: color("--paper"), strokeWidth: 0.5 },
          encoding: { x, y, tooltip, opacity: opacity(1) } },
        ...texts(false), ...texts(true),
      ],
    };
  };
  return draw("error-time", "For each algorithm and scalar, the run time of a query, and the distances and the rate of its false positives.", {
    hconcat: [
      panel("farthest false positive / B", "farthest_over_B", ladder.front_by_distance, [ladder.paper_bound],
        [{ name: "chosen", select: { type: "point", fields: ["algorithm"] }, bind: "legend" }]),
      panel("false positives, among non-collisions", "false_positive_rate", front_by_rate, [], []),
    ],
  });
}
