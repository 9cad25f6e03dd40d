// Tests the charts of sweeps (families at several values of their parameter), of false positives that refute
// a bound of 0, of misses, and of deciders (the stages that decide queries).
import assert from "node:assert/strict";
import { count, jsonOf, makeReport, open, pageOf, plugin, run } from "./session.mjs";

/** A subject may have a name that is a member of every object, such as toString. */
export async function showsSubjectsWithTheNamesOfMembers(browser) {
  const page = await open(browser, makeReport("members", ["--cases", "600", "--no-shrink", "--subject", "toString=basic,constructor=wang"]));
  for (const name of ["toString", "constructor"])
    assert.equal(await page.locator("#rates svg text", { hasText: name }).count(), 1);
  assert.ok((await page.locator("#findings-filter [name=subject] option").allTextContents()).includes("toString"));
}

export async function showsSweeps(browser) {
  const page = await open(browser, makeReport("swept",
    ["--sweep", "needle,stiff", "--steps", "3", "--cases", "1200", "--subject", "basic,wang"]));
  assert.equal(await page.isVisible("#sweeps-section"), true);
  // Each of 4 panels has 12 background marks, for 2 families, 2 subjects and 3 values. A result above 0 has a
  // second mark.
  const steps = Object.values(jsonOf("swept").sweeps).flatMap(Object.values).flat();
  const shown = ["false_negative_rate", "max_fp_distance_over_bound", "false_positive_rate", "ns_per_query"]
    .map((field) => steps.filter((step) => step[field] > 0).length);
  assert.ok(shown[0] >= 6); // basic misses at all values
  assert.equal(await count(page, "#sweeps .role-scope .mark-rect.role-mark path"), 4 * 12 + shown.reduce((a, b) => a + b));
}

/**
 * If a family has a single value of its parameter, it is no sweep, even with a separation. The page shows its
 * misses together with those of other families.
 */
export async function showsASingleValueBesideASweep(browser) {
  const family = "end-contact@1";
  run("fuzz", "--subject", "basic", "--cases", "200", "--no-shrink", "--family", family, "--db", "single-basic.db");
  run("fuzz", "--subject", "wang", "--cases", "200", "--no-shrink", "--seed", "2", "--family", `${family},end-contact@3,v-stiff@1`, "--db", "single-wang.db");
  run("report", "single-basic.db", "single-wang.db", "-o", "single");
  assert.ok(jsonOf("single").subjects.basic.vt.families[family].false_negatives > 0);
  const page = await open(browser, pageOf("single"));
  const rows = await page.evaluate(() => countRows(true).filter((row) => !isSweep(row)).map(({ subject, family: of }) => `${subject} ${of}`));
  assert.deepEqual(new Set(rows), new Set([`basic ${family}`, "wang v-stiff@1~drawn"]));
  assert.equal(await page.locator("#misses svg text", { hasText: family }).count() > 0, true);
}

/**
 * Each option has a row of charts. A chart has a point for each class and value for which the plotted number
 * is known.
 */
export async function showsValuesOfOptions(browser) {
  run("tightness", "--subject", `wang,${plugin("sampling")}:tolerance=*`, "--values", "0,0.01,1", "--cases", "1200", "--db", "options.db");
  run("report", "options.db", "-o", "options");
  const page = await open(browser, pageOf("options"));
  const steps = jsonOf("options").option_sweeps["sampling:tolerance=*"];
  assert.equal(steps.length, 9);
  const timed = steps.filter((step) => step.time_sort !== "none").length;
  assert.equal(await count(page, "#options .mark-symbol.role-mark path"), 3 * 9 + timed);
  const titles = await page.locator("#options .role-title-text text").allTextContents();
  assert.deepEqual(titles, ["missed, among collisions", "false positives, among non-collisions", "early, 99 % at most", "ns a query", "sampling:tolerance=*"]);
  const ends = await page.locator("#options .role-axis-label text").allTextContents();
  assert.ok(ends.includes("100 %") && ends.includes("0"));
}

export async function showsSweepsOfWhatIsNeverWrong(browser) {
  const page = await open(browser, makeReport("right", ["--sweep", "stiff", "--steps", "2", "--cases", "40", "--subject", "exact"]));
  assert.equal(await count(page, ".units:visible"), 0); // every subject claims a bound

  // Each of the 4 panels has a background mark for each of the 2 values. A result above 0 has a second mark;
  // here, only the 2 run times are above 0.
  assert.equal(await count(page, "#sweeps .role-scope .mark-rect.role-mark path"), 4 * 2 + 2);
}

/** If a subject claims a bound of 0, the ratio of a false positive is infinite. */
export async function showsAClaimOfNoDistanceThatIsRefuted(browser) {
  const page = await open(browser, makeReport("infinite", ["--sweep", "stiff", "--steps", "2", "--cases", "80", "--subject", `wang,exact,${plugin("claims_exact")}`]));
  const farthest = page.locator("#counts tbody tr:has-text('always') td:nth-child(9)");
  assert.deepEqual(await farthest.allTextContents(), ["10–∞", "10–∞"]);
  const ends = (chart) => page.locator(`#${chart} .role-axis-label text`).allTextContents();
  assert.ok((await ends("error-time")).includes("∞"));
  // Each of 3 subjects has a mark, and the failed subject also has a cross.
  assert.equal(await count(page, "#error-time .concat_0_group .mark-symbol.role-mark path"), 4);
  assert.match(await page.locator("#farthest").textContent(), /beyond a bound of 0/);
  // The chart shows the bound even if all false positives are beyond this bound.
  const beyond = await open(browser, makeReport("all-beyond", ["--cases", "40", "--family", "uniform", "--no-shrink", "--subject", plugin("claims_exact")]));
  assert.ok((await beyond.locator("#distances .role-axis-label text").allTextContents()).includes("1"));
  // The picture shows the plane between the primitives, which proves that the bound is refuted.
  assert.ok(await count(beyond, "#example .picture .plane") === 1);
}

/**
 * The map of misses has a column for each subject with a miss, and a row for each family with a miss. Each
 * class has a map of its own.
 */
export async function showsWhereCollisionsAreMissed(browser) {
  const page = await open(browser, pageOf("found"));
  const { families } = Object.entries(jsonOf("found").subjects.basic).reduce((all, [, ofKind]) => {
    for (const [name, each] of Object.entries(ofKind.families)) if (each.false_negatives > 0) all.families.add(name);
    return all;
  }, { families: new Set() });
  const labels = await page.locator("#misses .role-axis-label text").allTextContents();
  assert.deepEqual(new Set(labels), new Set(["basic", ...families]));
  assert.equal(await count(page, "#misses .mark-rect.role-mark path[fill^='rgb']"), families.size);
  assert.deepEqual(await page.locator("#misses .role-title-text text").allTextContents().then((titles) => titles.filter((title) => !title.includes("missed"))),
    ["degenerate", "extreme"]);
}

export async function showsWhatDecides(browser) {
  const page = await open(browser, makeReport("decided", ["--cases", "2200", "--kind", "vt,ee", "--subject", "adaptive,wang,exact"]));
  const { deciders, subjects } = jsonOf("decided");
  const families = [...new Set(Object.values(subjects.adaptive).flatMap((ofKind) => Object.keys(ofKind.families)))].sort();
  assert.deepEqual(deciders.map(({ family }) => family), ["", ...families]);
  const { queries, decided_by, time_over } = deciders[0];
  assert.equal(queries, 2200);
  const byWang = ["planes", "apart", "no-root", "culled", "tests"];
  const cleared = Object.values(subjects.adaptive).flatMap((ofKind) => byWang.map((why) => ofKind.rejected_by[why] ?? 0));
  assert.equal(decided_by.algorithm, cleared.reduce((a, b) => a + b));
  assert.ok(decided_by.filter > 0 && decided_by.exact > 0);
  assert.ok(time_over.wang > 0 && time_over.exact > 0);
  const rows = await page.locator("#deciders tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.deepEqual(rows.map(([subject, family]) => [subject, family]), ["all", ...families].map((family) => ["adaptive", family]));
  assert.equal(rows[0].length, 10);
  for (const [i, name] of ["algorithm", "filter", "finer", "exact"].entries()) {
    const [, share, times] = rows[0][3 + i].match(/^([\d.]+)(?: %)? \(([\d,]+)\)$/);
    assert.equal(Number(times.replaceAll(",", "")), decided_by[name]);
    assert.ok(Math.abs(Number(share) - (100 * decided_by[name]) / queries) < 0.06);
  }
  await page.click("#deciders th:has-text('exact arithmetic')");
  const most = deciders.reduce((a, b) => (b.decided_by.exact / b.queries > a.decided_by.exact / a.queries ? b : a));
  assert.equal(await page.locator("#deciders tbody tr td:nth-child(2)").first().textContent(), most.family);
}
