// Opens reports in Chromium as a user does and looks at what is drawn. Usage: page_test.mjs NEARMISS
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "../../reports/page/node_modules/playwright-core/index.mjs";

const nearmiss = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "nearmiss-page-"));

/** Runs nearmiss; exit code 1 (something was found) is fine here. */
function run(...args) {
  try {
    execFileSync(nearmiss, args, { cwd: folder, stdio: "pipe" });
  } catch (error) {
    if (error.status !== 1) throw error;
  }
}

function makeReport(name, fuzz, report = []) {
  run("fuzz", ...fuzz, "--db", `${name}.db`);
  run("report", `${name}.db`, "-o", name, ...report);
  return pathToFileURL(join(folder, name, "index.html")).href;
}

/** Opens a page that must draw without any complaint and without the network. */
async function open(browser, url) {
  const page = await browser.newPage({ offline: true });
  const complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => request.url().startsWith("http") && complaints.push(request.url()));
  await page.goto(url);
  await page.waitForSelector("body[data-drawn], body[data-error]");
  assert.equal(await page.getAttribute("body", "data-error"), null);
  assert.deepEqual(complaints, []);
  return page;
}

const count = (page, selector) => page.locator(selector).count();

async function showsFindings(browser) {
  const page = await open(browser, makeReport("found", ["--cases", "2200", "--subject", "basic,wang"]));
  const report = JSON.parse(readFileSync(join(folder, "found", "report.json")));

  const verdicts = await page.locator(".verdict").allTextContents();
  assert.equal(verdicts.length, 2);
  assert.match(verdicts[0], /FAIL.*basic.*MISSED/);
  assert.match(verdicts[1], /ok.*wang.*no miss/);
  assert.equal(await count(page, ".verdict.bad"), 1);

  assert.equal(await count(page, "#error-time path.point, #error-time .mark-symbol.role-mark path"), 4); // 2 subjects, 2 panels
  assert.ok((await count(page, "#distances .mark-line path")) >= 2);
  assert.equal(await count(page, "#distances .mark-rule.role-mark line"), 2); // the bound, in each panel
  assert.ok((await count(page, "#stages .mark-rect.role-mark path")) >= 4);

  assert.equal(await count(page, "#counts tbody tr"), 4);
  await page.check("#by-family");
  const families = Object.keys(report.oracle.families.vt).length;
  assert.ok(families >= 24);
  assert.equal(await count(page, "#counts tbody tr"), 4 * families); // 2 subjects, 2 kinds
  const column = (n) => page.locator(`#counts tbody tr td:nth-child(${n})`).allTextContents();
  await page.click("#counts th:has-text('false positives')");
  const sorted = (await column(8)).map((text) => Number(text.replaceAll(",", "")));
  assert.deepEqual(sorted, [...sorted].sort((a, b) => b - a));

  assert.equal(await count(page, "#oracle tbody tr"), 2 * families);
  assert.equal(await count(page, "#findings tbody tr"), report.findings.length);
  const command = await page.locator("#findings code").first().textContent();
  const kept = report.signatures.map((each) => each.seen).reduce((a, b) => a + b);
  assert.match(await page.textContent("#findings-note"), new RegExp(`^${kept.toLocaleString("en-US")} failures in ${report.signatures.length} ways`));
  const seen = await page.locator("#findings tbody tr td:nth-child(5)").allTextContents();
  assert.deepEqual(seen.map((text) => Number(text.replaceAll(",", ""))), report.findings.map((each) => each.seen));
  const shrunk = page.locator("#findings tbody tr").first().locator("pre");
  assert.match(await shrunk.first().textContent(), /^x0 \(.*, .*, .*\)/);
  assert.equal(await shrunk.last().isVisible(), false); // the query as it was found
  await page.locator("#findings summary").first().click();
  assert.equal(await shrunk.last().isVisible(), true);

  assert.equal(await count(page, "#findings svg.picture"), report.findings.length);
  const picture = page.locator("#findings svg.picture").first();
  assert.equal(await picture.locator(".moment.figure0").count() > 0, true);
  const drawn = () => picture.innerHTML();
  const before = await drawn();
  await picture.scrollIntoViewIfNeeded();
  const box = await picture.boundingBox();
  await page.mouse.move(box.x + 60, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 140, box.y + 90, { steps: 4 });
  await page.mouse.up();
  const byMouse = await drawn();
  assert.notEqual(byMouse, before);
  await picture.focus();
  await page.keyboard.press("ArrowLeft");
  assert.notEqual(await drawn(), byMouse);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator("#findings button").first().click();
  await page.waitForSelector("#findings button:has-text('copied')");
  assert.deepEqual((await page.evaluate(() => navigator.clipboard.readText())).split(" ").map(Number), report.findings[0].shrunk);

  const [, file] = command.match(/^nearmiss replay (cases\/\S+) --subject basic$/);
  assert.throws(() => execFileSync(nearmiss, ["replay", file, "--subject", "basic"], { cwd: join(folder, "found") }),
    { status: 1 }); // the command on the page finds it again
  await page.close();
}

async function showsThatNothingWasFound(browser) {
  const page = await open(browser, makeReport("clean", ["--cases", "100", "--family", "uniform-slow"]));
  assert.equal(await count(page, ".verdict.bad"), 0);
  assert.match(await page.textContent("#findings-note"), /^None/);
  assert.equal(await count(page, "#findings tbody tr"), 0);
  assert.match(await page.textContent("#distances"), /no false positive/);
  assert.equal(await page.isVisible("#baseline"), false);
  assert.equal(await page.isVisible("#sweeps-section"), false);
  await page.close();
}

async function showsSweeps(browser) {
  const page = await open(browser, makeReport("swept",
    ["--sweep", "needle,stiff", "--steps", "3", "--cases", "1200", "--subject", "basic,wang"]));
  assert.equal(await page.isVisible("#sweeps-section"), true);
  assert.equal(await count(page, "#sweeps .mark-line path"), 12); // 2 families, 3 panels, 2 subjects
  const crosses = await count(page, "#sweeps .mark-symbol.role-mark path[fill='#b3261e']");
  assert.equal(crosses, 18); // basic misses at all 3 values, and is marked in all panels
  await page.close();
}

async function showsTheBaseline(browser) {
  const url = makeReport("later", ["--cases", "2200", "--subject", "basic,wang", "--seed", "2"], ["--baseline", "found.db"]);
  const page = await open(browser, url);
  assert.equal(await page.isVisible("#baseline"), true);
  assert.match(await page.textContent("#baseline-new"), /^New: false-negative of basic, /);
  assert.equal(await count(page, "#baseline-table tbody tr"), 4);
  await page.close();
}

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
try {
  await showsFindings(browser);
  await showsThatNothingWasFound(browser);
  await showsTheBaseline(browser);
  await showsSweeps(browser);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
