// Tests times of impact (error against run time, table, histograms, pictures) and separations.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { count, folder, jsonOf, makeReport, open, pageOf, plugin, run } from "./session.mjs";

const texts = (page, selector) => page.locator(selector).allTextContents();

/** Each subject that gives times has a mark with its name; the subject with late times also has a cross. */
async function checkEarliness(page, { error_against_time }) {
  assert.deepEqual(error_against_time.front_by_earliness, ["exact"]);
  assert.equal(await count(page, "#earliness .mark-symbol.role-mark path"), 3 + 1);
  assert.equal(await count(page, "#earliness .mark-symbol.role-mark path[fill='#b3261e']"), 1);
  // Two ticks for each subject: the 99 % quantile and the largest error.
  assert.equal(await count(page, "#earliness .mark-rect.role-mark path"), 2 * 3);
  const dashed = await page.locator("#earliness .mark-rule.role-mark line").evaluateAll((all) =>
    all.filter((each) => each.getAttribute("stroke-dasharray") === "4,3").length);
  assert.equal(dashed, 1); // only the subject whose times are estimates
  assert.deepEqual(new Set(await texts(page, "#earliness .mark-text.role-mark text")), new Set(["always", "exact", "sampling"]));
  assert.deepEqual(await texts(page, "#earliness .role-legend-label text"), ["lower bound", "estimate"]);
}

async function checkTable(page, { subjects }) {
  const heading = await texts(page, "#times thead th");
  const rows = () => page.locator("#times tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  const column = (title) => heading.indexOf(title);
  const byClass = await rows();
  assert.equal(byClass.length, 3 * 2 * 2); // 3 subjects, 2 kinds, 2 classes
  for (const row of byClass) {
    const own = subjects[row[0]][row[1]].classes[row[2]];
    const isGiven = own.times_given > 0;
    assert.equal(row[column("sort")], !isGiven ? "–" : row[0] === "sampling" ? "estimate" : "lower bound");
    assert.equal(row[column("times")], own.times_given.toLocaleString("en-US"));
    assert.equal(row[column("late")], row[0] === "sampling" ? "–" : own.late.toLocaleString("en-US"));
    assert.equal(row[column("stuck")], own.stuck.toLocaleString("en-US"));
    for (const [title, field] of [["most", "max_early"], ["after t*", "max_after"]])
      assert.equal(row[column(title)], isGiven ? Number(own[field].toPrecision(3)).toString() : "–");
  }
  assert.equal(await count(page, "#times td.bad"), 4); // the late times of one subject
  await page.check("#times-by-family");
  assert.deepEqual(new Set((await rows()).map((row) => row[3])), new Set(["uniform", "planted", "even-roots"]));
  assert.equal((await rows()).length, 3 * 2 * 3);
  const late = (await texts(page, "#counts thead th")).indexOf("late");
  const cells = await texts(page, `#counts tbody td:nth-child(${late + 1})`);
  const counts = Object.values(subjects).flatMap((ofKind) => ["ee", "vt"].map((kind) => ofKind[kind]));
  assert.deepEqual(new Set(cells), new Set(counts.map((each) => (each.times_promised > 0 ? each.late.toLocaleString("en-US") : "–"))));
}

/**
 * Each subject and kind has a strip. Early times are left of the middle, times after the earliest time t* are
 * right of it.
 */
async function checkHistograms(page, { subjects }) {
  const sum = (list) => list.reduce((a, b) => a + b, 0);
  for (const [subject, ofKind] of Object.entries(subjects))
    for (const [kind, { early_histogram: early, after_histogram: after, times_given }] of Object.entries(ofKind)) {
      if (times_given === 0) continue;
      const bins = await page.evaluate(([name, of]) => binsOfErrors(timedRows().find((row) => row.subject === name && row.kind === of)), [subject, kind]);
      const at = (side) => bins.filter(({ place }) => Math.sign(place) === side).map((bin) => bin.count);
      assert.deepEqual([at(-1), at(0), at(1)], [early.slice(1).reverse(), [early[0] + after[0]], after.slice(1)]);
      assert.equal(sum(bins.map((bin) => bin.count)), times_given);
    }
  assert.equal(await count(page, "#time-errors .mark-area path"), 3 * 2);
  assert.equal(await count(page, "#time-errors .mark-rule.role-mark line"), 3 * 2);
  // The headers of the rows stand left of the charts of the first kind.
  assert.deepEqual((await texts(page, "#time-errors .role-row-header text")).filter((text) => text.includes("(")),
    ["always (lower bound)", "exact (lower bound)", "sampling (estimate)"]);
  const ticks = await texts(page, "#time-errors .role-axis-label text");
  for (const tick of ["−1e-4", "−1e-12", "0", "1e-12", "1e-4"]) assert.ok(ticks.includes(tick), tick);
}

async function checkPictures(page, { extreme_times, findings }) {
  assert.equal(await count(page, "#extreme-times .card"), extreme_times.length);
  const always = page.locator("#extreme-times .card", { hasText: "always vt" });
  assert.match(await always.first().textContent(), /early by 0\.\d+ of the step/);
  assert.match(await always.last().textContent(), /late by 0\.\d+ of the step/);
  assert.match(await page.locator("#extreme-times .card", { hasText: "sampling vt" }).last().textContent(), /after t\* by /);
  const late = findings.filter(({ what }) => what === "late");
  assert.ok(late.length > 0);
  while (await page.isVisible("#more-findings")) await page.click("#more-findings");
  const pictures = page.locator("#findings .card", { hasText: "late time of" }).locator("figure", { has: page.locator(".given") });
  assert.equal(await pictures.count(), late.length);
  const committed = findings.filter(({ what }) => what === "committed");
  assert.ok(committed.length > 0);
  assert.equal(await count(page, "#findings .card h3:text('step with contact of')"), committed.length);
  assert.match(await page.textContent("#findings-note"), /queries in which the step to a sound time, once rounded, has contact\./);
  const legends = await pictures.locator("figcaption").allTextContents();
  late.forEach(({ time, toi }, i) => {
    assert.equal(toi, 0.5);
    assert.ok(time < toi);
    const [, shown, after] = legends[i].match(/t\* = (\S+) toi = t\* \+ (\S+)$/);
    assert.ok(Math.abs(Number(shown) - time) <= 0.005 * time);
    assert.ok(Math.abs(Number(after) - (toi - time)) <= 0.005 * (toi - time));
  });
  assert.match(await page.locator("#findings .card", { hasText: "late time of always" }).first().textContent(), /late time of always, by [\d.e-]+ of the step/);
}

export async function showsTimesOfImpact(browser) {
  const page = await open(browser, makeReport("timed",
    ["--family", "uniform,planted,even-roots", "--cases", "900", "--subject", `wang,exact,${plugin("promises")},${plugin("sampling")}`]));
  const report = jsonOf("timed");
  assert.match((await texts(page, ".verdict")).find((text) => text.includes("always")), /^FAILalways0 of \d+, .*\d+ of \d+/);
  await checkEarliness(page, report);
  await checkTable(page, report);
  await checkHistograms(page, report);
  await checkPictures(page, report);
  const links = await page.locator("footer a").evaluateAll((all) => all.map((each) => each.getAttribute("href")));
  assert.ok(links.includes("times.csv"));
}

export async function showsSeparations(browser) {
  const page = await open(browser, makeReport("apart",
    ["--family", "uniform", "--separation", "0.25", "--cases", "400", "--subject", `exact,${plugin("promises")}`]));
  assert.match(await page.textContent("#runs"), /, separation 0\.25, /);
  // Shrinking simplifies the separation together with the coordinates.
  const ofFinding = jsonOf("apart").findings[0].shrunk[24];
  for (const [section, h] of [["findings", ofFinding], ["farthest", 0.25], ["extreme-times", 0.25]]) {
    assert.ok((await page.locator(`#${section} figcaption`).first().textContent()).startsWith(`h = ${h}`), section);
    assert.ok((await page.locator(`#${section} pre`).first().textContent()).endsWith(`\nh  ${h}`), section);
  }
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator("#extreme-times summary").first().click();
  const button = page.locator("#extreme-times button.copy").first();
  await button.click();
  await page.locator("#extreme-times").getByText("copied", { exact: true }).waitFor();
  assert.deepEqual((await page.evaluate(() => navigator.clipboard.readText())).split(" ").map(Number), jsonOf("apart").extreme_times[0].query);
  assert.equal(jsonOf("apart").extreme_times[0].query[24], 0.25);
}

/**
 * At t*, the distance equals the separation h for the first time. If the distance is never below h, a lower
 * bound after t* is not late. The first query of touching.vt is of this sort. The time for the other query is
 * late.
 */
export async function showsWhichTimesAreLate(browser) {
  const [end, triangle] = ["0.25 0.25", "0 0 0  1 0 0  0 1 0"];
  const query = (from, to) => `${end} ${from}  ${triangle}   ${end} ${to}  ${triangle}  0.5\n`;
  for (const [name, queries, text] of [["touching", query(0.5, 2) + query(1.3, -0.7), "after t* by 0.5 of the step"],
    ["passing", query(1.3, -0.7), "late by 0.1 of the step"]]) {
    writeFileSync(join(folder, `${name}.vt`), queries);
    run("replay", `${name}.vt`, "--subject", plugin("promises"), "--db", `${name}.db`);
    run("report", `${name}.db`, "-o", name);
    const page = await open(browser, pageOf(name));
    assert.equal(jsonOf(name).subjects.always.vt.late, 1);
    assert.ok((await page.textContent("#extreme-times .card")).includes(text), text);
  }
}

/**
 * Each subject has a strip for each kind, even for a kind that it was not asked about, so that the subject's
 * name stands beside its strips.
 */
export async function namesEveryStripOfTimes(browser) {
  run("fuzz", "--subject", "exact", "--cases", "40", "--kind", "vt", "--family", "planted", "--db", "strips-exact.db");
  run("fuzz", "--subject", "basic", "--cases", "40", "--kind", "ee", "--family", "planted", "--seed", "2", "--db", "strips-basic.db");
  run("report", "strips-exact.db", "strips-basic.db", "-o", "strips");
  const page = await open(browser, pageOf("strips"));
  assert.deepEqual((await texts(page, "#time-errors .role-row-header text")).filter((text) => text.includes("(")),
    ["basic (estimate)", "exact (lower bound)"]);
  assert.equal(await count(page, "#time-errors .mark-area path"), 2 * 2);
}
