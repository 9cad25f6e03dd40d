// Draws simulations: the same cloth with each subject as its CCD.
"use strict";

const isSimulation = (family) => report.simulations?.[family] !== undefined;
const simulationName = (family) => family.replace(/^scene:sim:/, "");

/** The steps of all simulations: [{scene, subject, step, queries, ...}]. */
const simulatedSteps = () => Object.entries(report.simulations ?? {}).flatMap(([family, ofSubject]) =>
  Object.entries(ofSubject).flatMap(([subject, lists]) => lists.step.map((step, i) => ({
    scene: simulationName(family), subject, ...Object.fromEntries(Object.entries(lists).map(([name, list]) => [name, list[i]])),
  }))));

/** One row for each simulation and subject: sums over the steps, the tangles, and the energy. */
function simulations() {
  const all = new Map();
  for (const step of simulatedSteps()) {
    const key = `${step.scene}\n${step.subject}`;
    if (!all.has(key)) all.set(key, []);
    all.get(key).push(step);
  }
  const answers = countRows(true).filter((row) => isSimulation(row.family));
  return [...all.values()].map((steps) => {
    const last = steps[steps.length - 1];
    const [sum] = summed(steps, ["scene", "subject"]);
    const most = (field) => steps.reduce((value, step) => Math.max(value, step[field]), 0);
    const own = answers.filter((row) => simulationName(row.family) === sum.scene && row.subject === sum.subject);
    const subject_ns = own.reduce((time, row) => time + (row.ns_per_query ?? 0) * row.queries, 0);
    return { ...sum, subject_ns, steps: steps.length, since: steps.find((step) => step.tangled > 0)?.step, tangled: most("tangled"), left: last.tangled,
      picojoules: most("picojoules"), rest: last.picojoules };
  });
}

const joules = (pico) => `${short(1e-12 * pico)} J`;

function drawSimulations() {
  const rows = simulations();
  if (rows.length === 0) return;
  show("simulations-section");
  fillTable(element("simulations"), [
    text("scene", "scene"), measures.subject, count("steps", "steps"), count("rounds", "rounds"), count("answered", "queries"), count("unanswered", "unanswered"), count("reported", "positives"),
    count("collisions", "collisions"), count("missed", "false_negatives", true), count("false positives", "false_positives"),
    count("unresolved", "unresolved"), count("tangled: most", "tangled", true),
    { title: "first in step", number: (r) => r.since ?? -1, text: (r) => (r.since === undefined ? "–" : integer(r.since)) },
    count("tangled at the end", "left", true),
    { title: "energy: most", number: (r) => r.picojoules, text: (r) => joules(r.picojoules) },
    { title: "energy at the end", number: (r) => r.rest, text: (r) => joules(r.rest) },
    { title: "solver", number: (r) => r.solver_ns, text: (r) => duration(1e-9 * r.solver_ns) },
    { title: "CCD", number: (r) => r.subject_ns, text: (r) => duration(1e-9 * r.subject_ns) },
  ], rows, true);
  for (const picture of report.pictures ?? [])
    if (isSimulation(picture.step.replace(/ with .*$/, ""))) element("simulation-pictures").append(drawMesh([picture]));
}

/** Draws for each step what each subject reported and missed, the tangles, and the energy. */
function drawSimulatedSteps() {
  const rows = simulatedSteps().map((row) => ({ ...row, joules: 1e-12 * row.picojoules }));
  const scenes = [...new Set(rows.map((row) => row.scene))];
  const line = (scene, field, title, first) => ({
    width: 190, height: 120, title: first ? { text: scene, anchor: "start" } : undefined,
    data: { values: rows.filter((row) => row.scene === scene) }, mark: { type: "line", strokeWidth: 1.5 },
    encoding: { x: { field: "step", type: "quantitative", title: "step", axis: { tickMinStep: 1, tickCount: 5 } },
      y: { field, type: "quantitative", title, axis: { tickCount: 4, format: "~s" } }, color: subjectColor,
      tooltip: [{ field: "subject" }, { field: "step" }, { field, title, ...digits(4) }] },
  });
  return draw("simulated-steps", "For each step of a simulation, the pairs that each subject reported and missed, the tangled pairs and the kinetic energy.", {
    vconcat: scenes.map((scene) => ({ hconcat: [
      line(scene, "positives", "reported", true), line(scene, "false_negatives", "missed", false),
      line(scene, "tangled", "tangled", false), line(scene, "joules", "kinetic energy, J", false),
    ] })),
  });
}
