// Makes reports in a temporary folder, and opens them in a browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

export const nearmiss = process.argv[2];
export const folder = mkdtempSync(join(tmpdir(), "nearmiss-page-"));
export const plugin = (name) => join(dirname(nearmiss), "plugins", `${name}.so`);
export const removeFolder = () => rmSync(folder, { recursive: true });

/** Runs nearmiss. Exit code 1 is no error here, because it only means that nearmiss found a failure. */
export function run(...args) {
  try {
    execFileSync(nearmiss, args, { cwd: folder, stdio: "pipe" });
  } catch (error) {
    if (error.status !== 1) throw error;
  }
}

export const pageOf = (name) => pathToFileURL(join(folder, name, "index.html")).href;
export const jsonOf = (name) => JSON.parse(readFileSync(join(folder, name, "report.json")));

/** The command that replays a finding, as the page of the report `name` shows it, with the report's path. */
export const inAnyFolder = ({ again }, name) => again.replace(" cases/", ` ${join(folder, name)}/cases/`);

/** Runs a campaign and writes its report. Returns the address of the report's page. */
export function makeReport(name, fuzz, report = []) {
  run("fuzz", ...fuzz, "--db", `${name}.db`);
  run("report", `${name}.db`, "-o", name, ...report);
  return pageOf(name);
}

/** Opens a page. Expects that it draws without errors, and without the network. */
export async function open(browser, url, options = {}) {
  const page = await browser.newPage({ offline: true, ...options });
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

export const count = (page, selector) => page.locator(selector).count();

/** The id of a finding's card, given the finding's place in report.json. */
export const idOf = (page, index) => page.evaluate((i) => idOf(report.findings[i]), index);
