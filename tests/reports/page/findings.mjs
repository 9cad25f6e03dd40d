// Tests findings, verdicts and counters: in a campaign with failures, in one without failures, and with a
// baseline.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { count, folder, idOf, inAnyFolder, jsonOf, makeReport, nearmiss, open, pageOf, plugin, run } from "./session.mjs";

async function checkVerdicts(page, report) {
  const verdicts = await page.locator(".verdict").allTextContents();
  assert.equal(verdicts.length, 2);
  assert.match(verdicts[0], /^FAILbasicordinary vt \d+ of \d+, ee \d+ of \d+degenerate [\d.]+ % · extreme [\d.]+ % · in all [\d,]+ of [\d,]+/);
  assert.match(verdicts[0], /farthest [\d.]+ times wang's bound \(it claims none\)/);
  assert.match(verdicts[1], /^okwang0 of [\d,]+, below [\d.]+ % at 95 %ordinary 0 · degenerate 0 · extreme 0/);
  assert.match(verdicts[1], /farthest at 0\.\d+ of its bound/);
  assert.match(verdicts[1], /[\d.]+, 99 % [\d.]+/);
  assert.equal(await count(page, ".verdict.bad"), 1);
  const [basic] = report.verdicts;
  const exoticness = ({ class: of }) => ["ordinary", "degenerate", "extreme"].indexOf(of);
  assert.equal(exoticness(report.findings[basic.finding]), Math.min(...report.findings.map(exoticness)));
  assert.equal(await page.getAttribute(".verdict.bad button.copy", "title"), inAnyFolder(report.findings[basic.finding], "found"));

  assert.match(await page.textContent("#headline"), /^basic failed: it missed \d+ of \d+ degenerate vt and \d+ of \d+ degenerate ee collisions; wang did not fail, in 2,200 queries\.$/);
  assert.equal(await count(page, "#headline.bad"), 1);
  assert.ok((await page.locator("nav a").allTextContents()).includes(`Findings (${report.findings.length})`));
}

async function checkCharts(page, report) {
  assert.equal(await page.isVisible("#error-time-section"), false); // it would only repeat the tables
  const reported = (kind) => new Set(Object.values(report.subjects).flatMap((ofKind) =>
    Object.entries(ofKind[kind].families).filter(([, each]) => each.false_positives > 0).map(([family]) => family)));
  assert.deepEqual(new Set(await page.locator("#rates .role-axis-label text").allTextContents().then((labels) =>
    labels.filter((label) => !label.endsWith("%")))), new Set([...reported("vt"), ...reported("ee")]));
  assert.equal(await count(page, "#distances .mark-line path"), 8); // 2 subjects, 2 kinds; numbers and shares
  assert.equal(await count(page, "#distances .mark-rule.role-mark line"), 4); // the bound, in each panel
  assert.ok((await count(page, "#stages .mark-rect.role-mark path")) >= 4);
  assert.deepEqual(await page.locator("#stages .role-legend-label text").allTextContents(), report.stages);
}

async function checkTables(page, report) {
  assert.equal(await page.isVisible("#picker"), false);

  assert.equal(await page.isVisible("#deciders-part"), false); // neither subject passes queries on

  assert.equal(await count(page, "#counts tbody tr"), 4);
  await page.check("#by-class");
  const classes = await page.locator("#counts tbody tr:has-text('wang'):has-text('vt') td:nth-child(3)").allTextContents();
  assert.deepEqual(classes, ["ordinary", "degenerate", "extreme"]);
  assert.equal(await count(page, "#counts tbody tr"), 4 * 3);
  await page.uncheck("#by-class");
  await page.check("#by-family");
  const families = Object.keys(report.oracle.families.vt).length;
  assert.ok(families >= 24);
  assert.equal(await count(page, "#counts tbody tr"), 4 * families); // 2 subjects, 2 kinds
  const column = (n) => page.locator(`#counts tbody tr td:nth-child(${n})`).allTextContents();
  await page.click("#counts th:has-text('false positives')");
  const sorted = (await column(8)).map((text) => Number(text.replaceAll(",", "")));
  assert.deepEqual(sorted, [...sorted].sort((a, b) => b - a));

  assert.equal(await count(page, "#oracle tbody tr"), 2);
  await page.check("#oracle-by-family");
  assert.equal(await count(page, "#oracle tbody tr"), 2 * families);
}

/** Every section with distances says that basic claims no bound, and marks the distances of basic with **. */
async function checkUnits(page) {
  const notes = await page.locator(".units:visible").allTextContents();
  assert.ok(notes.length >= 3);
  for (const note of notes) assert.match(note, /^\*\* basic claims no bound\. These distances are in units of wang's bound/);
  const marks = (name) => page.locator(`#counts tbody tr:has(td:first-child:text-is("${name}")) td:has-text("**")`);
  assert.ok((await marks("basic").count()) > 0);
  assert.equal(await marks("wang").count(), 0);
  const far = (name) => page.locator(`#farthest .card:has-text("${name} vt")`).textContent();
  assert.match(await far("basic"), /[\d.]+ times wang's bound \(it claims none\)/);
  assert.match(await far("wang"), /at [\d.]+ of its bound/);
}

async function checkFindings(page, report) {
  assert.ok(report.findings.length > 24);
  assert.equal(await count(page, "#findings .card"), 24);
  const kept = report.signatures.map((each) => each.seen).reduce((a, b) => a + b);
  assert.match(await page.textContent("#findings-note"), new RegExp(`^${kept.toLocaleString("en-US")} failures in ${report.signatures.length} ways`));
  const common = await page.locator("#common-factors li").allTextContents();
  assert.ok(common.length > 0);
  assert.deepEqual(common, report.common_factors.map((each) => `${each.subject} ${each.kind}, ${each.family}: ${each.text}.`));
  const first = report.findings[0];
  const card = page.locator(`#${await idOf(page, 0)}`);
  assert.match(await card.textContent(), new RegExp(`${first.seen === 1 ? "seen once" : `seen ${first.seen.toLocaleString("en-US")} times`}`));
  const shrunk = card.locator("pre").first();
  assert.match(await shrunk.textContent(), /^x0 \(.*, .*, .*\)/);
  assert.equal(await shrunk.isVisible(), false);
  await card.locator("summary").first().click();
  assert.equal(await shrunk.isVisible(), true);
}

/** Findings can be filtered by fields and by words. A subject in the first table links to its findings. */
async function checkFilter(page, report) {
  const shown = () => page.textContent("#findings-count");
  const of = (test) => report.findings.filter(test).length;
  await page.selectOption("#findings-filter [name=kind]", "ee");
  const edges = of(({ kind }) => kind === "ee");
  assert.equal(await shown(), `${Math.min(24, edges)} of ${edges} shown, out of ${report.findings.length}`);
  await page.selectOption("#findings-filter [name=class]", "extreme");
  const extreme = of((each) => each.kind === "ee" && each.class === "extreme");
  assert.ok(extreme > 0 && extreme < edges);
  assert.equal(await shown(), `${Math.min(24, extreme)} of ${extreme} shown, out of ${report.findings.length}`);
  await page.selectOption("#findings-filter [name=class]", "");
  const { family } = report.findings.find(({ kind }) => kind === "ee");
  await page.selectOption("#findings-filter [name=family]", family);
  const some = of((each) => each.kind === "ee" && each.family === family);
  assert.equal(await shown(), `${some} of ${some} shown, out of ${report.findings.length}`);
  await page.fill("#findings-filter [name=words]", "Missed edge-edge");
  await page.press("#findings-filter [name=words]", "Enter");
  assert.equal(await shown(), `${some} of ${some} shown, out of ${report.findings.length}`);
  await page.fill("#findings-filter [name=words]", "no such words");
  assert.equal(await count(page, "#findings .card"), 0);
  await page.locator(".verdict.bad a", { hasText: "basic" }).click();
  assert.equal(await shown(), `24 of ${report.findings.length} shown`);
  assert.equal(await page.inputValue("#findings-filter [name=words]"), "");
  await page.click("#more-findings");
  assert.equal(await count(page, "#findings .card"), Math.min(48, report.findings.length));
  assert.equal(await page.evaluate(() => [...document.querySelectorAll("#findings .card")].indexOf(document.activeElement)), 24);
  await page.locator(".verdict.bad a", { hasText: "show" }).click();
  await page.locator(`#${await idOf(page, report.verdicts[0].finding)}.open`).waitFor();
}

/** A finding opens large: its picture turns, zooms in, and runs through the step together with its plots. */
async function checkThatAFindingOpensLarge(page) {
  assert.equal(await count(page, "#findings svg.picture"), 24);
  const card = page.locator("#findings .card").first();
  await card.locator(".thumbnail").click();
  const picture = card.locator("svg.picture");
  assert.ok((await picture.boundingBox()).width >= 600);
  assert.equal(await picture.locator(".moment.primitive0").count() > 0, true);
  assert.deepEqual(await picture.locator("text").allTextContents(), ["x0", "x1", "x2", "x3"]);
  assert.equal(await card.locator("svg.plot").count(), 2);
  const seen = [await picture.innerHTML()];
  const changes = async (act) => {
    await act();
    seen.push(await picture.innerHTML());
    assert.equal(new Set(seen).size, seen.length);
  };
  await picture.scrollIntoViewIfNeeded();
  const box = await picture.boundingBox();
  await changes(async () => {
    await page.mouse.move(box.x + 60, box.y + 60);
    await page.mouse.down();
    await page.mouse.move(box.x + 140, box.y + 90, { steps: 4 });
    await page.mouse.up();
  });
  await changes(() => page.keyboard.press("ArrowLeft"));
  const plot = await card.locator("svg.plot").first().innerHTML();
  await changes(() => card.getByRole("slider").fill("0.25"));
  assert.equal(await card.locator("output").textContent(), "t = 0.25");
  assert.notEqual(await card.locator("svg.plot").first().innerHTML(), plot);
  await changes(() => card.getByRole("button", { name: "larger", exact: true }).click());
  await changes(async () => {
    await card.getByRole("button", { name: "play" }).click();
    for (let i = 0; i < 250 && (await picture.innerHTML()) === seen.at(-1); ++i) await page.waitForTimeout(20); // the first frame
  });
  await card.getByRole("button", { name: "reduce the picture" }).click();
  assert.equal(await card.locator(".thumbnail").count(), 1);
}

/**
 * The failed subjects come first, then the simplest failure, then the findings. The address of a finding
 * opens this finding in every report that has it.
 */
async function checkOrderAndAddresses(browser, page, report) {
  const titles = await page.locator("nav a").allTextContents();
  assert.deepEqual(titles.slice(0, 3), ["The simplest failure", `Findings (${report.findings.length})`, "The slowest queries"]);
  assert.ok((await page.textContent("#example .card.open")).includes(inAnyFolder(report.findings[report.verdicts[0].finding], "found")));
  run("report", "found.db", "-o", "again");
  renameSync(join(folder, "again"), join(folder, "moved to 'here'"));
  const id = await idOf(page, report.findings.length - 1);
  const again = await open(browser, `${pageOf("moved to 'here'")}#${id}`);
  const moved = join(folder, "moved to 'here'");
  assert.equal(await again.textContent("#findings-part .commands-note"), `The commands work in any folder, on a machine that has this report in ${moved}/`);
  const command = await again.textContent(`#${id}.open code`);
  assert.equal(command, report.findings.at(-1).again.replace(/cases\S+/, (file) => `'${`${moved}/${file}`.replaceAll("'", "'\\''")}'`));
  assert.throws(() => execFileSync("sh", ["-c", command.replace(/^nearmiss/, nearmiss)], { cwd: "/", stdio: "pipe" }), { status: 1 });
  assert.ok(await again.locator(`#${id}`).evaluate((card) => Math.abs(card.getBoundingClientRect().top) < innerHeight / 2));
  await again.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await again.locator(`#${id} .link`).click();
  assert.equal(await again.evaluate(() => navigator.clipboard.readText()), again.url());
  await again.evaluate(() => { location.hash = "#finding-gone"; });
  await again.getByText("does not have the finding").waitFor();
}

/** The buttons of the first finding copy the command, the query, and its certificate. */
async function checkCopies(page, report, command) {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  const card = page.locator(`#${await idOf(page, 0)}`);
  const copied = async (number) => {
    const buttons = card.locator("button.copy");
    await buttons.nth(number).click();
    await buttons.nth(number).and(page.getByText("copied", { exact: true })).waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  assert.equal(await copied(0), command);
  await card.locator("summary").first().click();
  assert.deepEqual((await copied(1)).split(" ").map(Number), report.findings[0].shrunk);
  assert.equal(await copied(2), report.findings[0].certificate);
  assert.equal(JSON.parse(report.findings[0].certificate).claim, "meets");
}

async function checkOtherSections(page) {
  assert.equal(await count(page, "#farthest svg.picture"), 4); // one for each subject and kind
  const far = await page.locator("#counts tbody a").evaluateAll((links) => links.map((link) => link.getAttribute("href")));
  assert.ok(far.length > 20);
  for (const file of far) readFileSync(join(folder, "found", file));
  assert.equal(await count(page, "#slowest tbody tr"), 10); // five for each subject
  assert.equal(await page.isVisible("#power-section"), false);
  assert.equal(await page.isVisible("#environments-section"), false);
  const again = await page.locator("#how code").textContent();
  assert.equal(again, "nearmiss fuzz --subject basic,wang --compare 4096 --seed 1 --family all --kind vt,ee --cases 2200");
}

/**
 * Tests two versions of a CCD: the queries that the later version fixes or breaks, and the replay of the
 * first broken query.
 */
export async function showsVersions(browser) {
  const page = await open(browser, makeReport("versions", ["--subject", `old=${plugin("v1")},new=${plugin("v2")},vt=${plugin("v3")}`, "--family", "uniform", "--cases", "400"]));
  const { versions, findings } = jsonOf("versions");
  const rows = await page.locator("#versions tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.deepEqual(rows, versions.map((each) => ["after", "before", "class", "kind", "fixed", "broken", "both", "neither", "queries"].map((key) => String(each[key]))));
  const again = inAnyFolder(findings.find((each) => each.broken_since === "old"), "versions");
  assert.match(again, /--subject old=\S+v1\.so,new=\S+v2\.so /);
  const lines = await page.locator("#broken > li").allTextContents();
  assert.equal(lines.filter((line) => line.startsWith("new against old: ") && line.includes(again)).length, 1);
  assert.ok(lines.includes("vt against old: ee is not compared, because one of them was not asked about it"));
}

export async function showsFindings(browser) {
  const page = await open(browser, makeReport("found", ["--cases", "2200", "--subject", "basic,wang", "--kind", "vt,ee"]));
  const report = jsonOf("found");
  await checkVerdicts(page, report);
  await checkCharts(page, report);
  await checkTables(page, report);
  await checkUnits(page);
  await checkFindings(page, report);
  await checkThatAFindingOpensLarge(page);
  await checkOrderAndAddresses(browser, page, report);
  await checkFilter(page, report);
  const command = await page.locator("#findings code").first().textContent();
  await checkCopies(page, report, command);
  await checkOtherSections(page);

  const [, file] = command.match(/^nearmiss replay (\/\S+) --subject basic$/);
  assert.throws(() => execFileSync(nearmiss, ["replay", file, "--subject", "basic"], { cwd: "/" }),
    { status: 1 }); // the copied command fails again
}

/**
 * Tests findings of the kinds vv and ve. The text of a finding has the places of the vertices, and the
 * separation. The finding's picture shows all vertices; the command that repeats the finding exits with 1,
 * as the failure occurs again; and the certificate names the finding's kind.
 * Tables and charts have both kinds.
 */
export async function showsVerticesAndEdges(browser) {
  const page = await open(browser, makeReport("vertices", ["--cases", "20000", "--subject", "basic", "--kind", "vv,ve"]));
  const { findings } = jsonOf("vertices");
  const captions = { vv: "Two vertices", ve: "A vertex and an edge" };
  const vertices = { vv: 2, ve: 3 };
  assert.deepEqual(new Set(findings.map(({ kind }) => kind)), new Set(Object.keys(vertices)));
  for (const [index, { kind, shrunk }] of findings.entries()) {
    const lines = (await page.locator(`#${await idOf(page, index)} pre`).first().textContent()).split("\n");
    const place = (half, i) => [0, 1, 2].map((k) => shrunk[3 * (half * vertices[kind] + i) + k] + 0); // no -0
    const numbers = (line) => line.match(/-?[\d.]+(e[-+]?\d+)?/g).map(Number);
    const expected = [...Array(vertices[kind]).keys()].map((i) => [i, ...place(0, i), ...(String(place(0, i)) === String(place(1, i)) ? [] : place(1, i))]);
    assert.deepEqual(lines.map(numbers), [...expected, [shrunk.at(-1)]]);
    const picture = page.locator(`#${await idOf(page, index)} svg.picture`);
    assert.ok((await picture.getAttribute("aria-label")).startsWith(captions[kind]));
    assert.equal(await picture.locator("circle").count(), 3 * vertices[kind]); // at t = 0, t = 1, and between
    assert.equal(await picture.locator(".path").count(), vertices[kind]);
  }
  for (const kind of Object.keys(vertices)) {
    const { again, certificate, shrunk } = findings.find((each) => each.kind === kind);
    assert.equal(JSON.parse(certificate).kind, kind);
    assert.equal(shrunk.length, 6 * vertices[kind] + 1);
    assert.throws(() => execFileSync(nearmiss, again.split(" ").slice(1), { cwd: join(folder, "vertices"), stdio: "pipe" }), { status: 1 });
  }
  assert.deepEqual(await page.locator("#counts tbody td:nth-child(2)").allTextContents(), ["vv", "ve"]);
  const titles = await page.locator("#distances svg text").allTextContents();
  for (const title of ["vertex-vertex", "vertex-edge"]) assert.ok(titles.some((text) => text.startsWith(title)), title);
}

/** A finding shows what the subject wrote to standard error before it failed. */
export async function showsStandardError(browser) {
  writeFileSync(join(folder, "exits.sh"), "printf 'nearmiss 3\\nname exits\\nkinds vt\\n\\n'; head -c 1 >/dev/null; printf 'the <b>reason</b>\\nno licence\\n' >&2; exit 3\n");
  const page = await open(browser, makeReport("exits", ["--cases", "20", "--subject", "pipe:sh exits.sh"]));
  const [finding] = jsonOf("exits").findings;
  assert.equal(finding.signature, "vt exception no licence");
  assert.deepEqual(finding.errors, ["the <b>reason</b>", "no licence"]);
  const card = page.locator(`#${await idOf(page, 0)}`);
  await card.getByText("its standard error, and the stack of a crash").click();
  assert.equal(await card.locator("details[open] pre").textContent(), finding.errors.join("\n"));
}

export async function showsThatNothingWasFound(browser) {
  const page = await open(browser, makeReport("clean", ["--cases", "100", "--family", "uniform-slow"]));
  assert.equal(await count(page, ".verdict.bad"), 0);
  assert.match(await page.textContent("#findings-note"), /^None/);
  assert.deepEqual((await page.locator("nav a").allTextContents()).slice(-3), ["Findings (0)", "Glossary", "How this was run"]);
  assert.equal(await count(page, "#findings .card"), 0);
  for (const left of ["baseline", "rates-section", "distances-section", "sweeps-section", "power-section", "environments-section", "tightness-section", "farthest-section",
    "times-section", "time-errors-section", "extreme-times-section"])
    assert.equal(await page.isVisible(`#${left}`), false, left);
  assert.match(await page.textContent("#headline"), /^wang did not fail, in 100 queries\.$/);
  assert.equal(await count(page, "#headline.bad"), 0);
}

export async function showsTheBaseline(browser) {
  const url = makeReport("later", ["--cases", "2200", "--kind", "vt,ee", "--subject", "basic,wang,basic-plain", "--seed", "2"], ["--baseline", "found.db"]);
  const page = await open(browser, url);
  assert.equal(await page.isVisible("#baseline"), true);
  const news = await page.textContent("#news");
  assert.match(news, /Not in the baseline: basic-plain\./);
  assert.match(news, /basic: \d+ ways to fail as before, \d+ not in the baseline, as chance explains/);
  assert.doesNotMatch(news, /basic(-plain)?: \d+ new/); // the baseline has this failure
  assert.match(news, /false-negative, [^(]+ \(first seen 20\d\d-\S+Z by version [\d.]+, last seen 20\d\d-\S+Z by version [\d.]+\)/);
  assert.match(news, / run times (differs by more than those of equal campaigns do|are slower and \d+ faster than in equal campaigns)\./);
  assert.match(news, /By chance, about \d+ ways that are not in the baseline were expected\./);
  assert.equal(await count(page, "#news details[open]"), 0);
  assert.match(await page.locator(".verdict", { hasText: /^FAILbasicordinary/ }).textContent(), /nothing worse\d+ ways as before/);
  assert.match(await page.locator(".verdict", { hasText: "basic-plain" }).textContent(), /not in the baseline/);
  assert.match(await page.textContent("#headline"), / ways? to fail as before, .* since the baseline\.$/);
  assert.equal(await count(page, "#headline.bad"), 1);
  assert.equal(await count(page, "#before-and-now tbody tr"), 4); // basic and wang, for both kinds
  assert.match(await page.textContent("#changed-facts"), /seed \(1 → 2\)/);
  const points = (panel) => count(page, `#error-time .concat_${panel}_group .mark-symbol.role-mark path`);
  // Each panel has a point for each of 3 subjects, and a cross for each of the 2 subjects that missed
  // collisions.
  assert.deepEqual([await points(0), await points(1)], [5, 5]);
  assert.equal(await count(page, "#error-time .mark-symbol.role-mark path[fill='#b3261e']"), 4);
  assert.equal(await count(page, "#error-time .mark-line path"), 2); // the front
  assert.doesNotMatch(await page.textContent("#findings"), /NEW since the baseline/);
}

export async function showsWhatIsNewSinceTheBaseline(browser) {
  makeReport("without-failure", ["--cases", "100", "--family", "uniform-slow", "--subject", "basic-plain"]);
  const url = makeReport("with-failures", ["--cases", "2200", "--subject", "basic-plain", "--seed", "2"], ["--baseline", "without-failure.db"]);
  const page = await open(browser, url);
  assert.match(await page.textContent("#news"), /basic-plain: \d+ new ways to fail/);
  assert.match(await page.locator(".verdict.bad").textContent(), /\d+ new ways to fail/);
  assert.match(await page.locator("#findings .card").first().textContent(), /NEW since the baseline/);
}
