// Opens reports in Chromium as a user does, and checks what is drawn. Usage: page_test.mjs NEARMISS
import { chromium } from "../../reports/page/node_modules/playwright-core/index.mjs";
import { hasNoBarriers, staysQuickWithManyFindings } from "./page/access.mjs";
import { showsAClaimOfNoDistanceThatIsRefuted, showsSweeps, showsSubjectsWithTheNamesOfMembers, showsASingleValueBesideASweep, showsSweepsOfWhatIsNeverWrong, showsValuesOfOptions, showsWhatDecides, showsWhereCollisionsAreMissed } from "./page/charts.mjs";
import { showsFindings, showsStandardError, showsVersions, showsVerticesAndEdges, showsThatNothingWasFound, showsTheBaseline, showsWhatIsNewSinceTheBaseline } from "./page/findings.mjs";
import { answersBeforeScrolling } from "./page/first_screen.mjs";
import { showsTheNights } from "./page/history.mjs";
import { showsTheLadderAndTheAudit } from "./page/ladder.mjs";
import { showsSceneStepsAndMeshes, showsScenes, showsSimulations } from "./page/scenes.mjs";
import { everyReportFollowsItsSchema } from "./page/schema.mjs";
import { removeFolder } from "./page/session.mjs";
import { drawsAMixOfRuns, drawsManySubjectsWithoutALadder, showsAChoiceOfManySubjects, showsWhatIsBeyondAContract } from "./page/subjects.mjs";
import { fitsEveryMedium, showsEnvironments, showsThePowerOfDetection } from "./page/tables.mjs";
import { namesEveryStripOfTimes, showsSeparations, showsTimesOfImpact, showsWhichTimesAreLate } from "./page/times.mjs";

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
/** Later tests open reports that earlier tests have made. */
const tests = [
  showsFindings, showsVerticesAndEdges, showsThatNothingWasFound, showsStandardError, showsVersions,
  showsTheBaseline, showsWhatIsNewSinceTheBaseline, showsTheNights, showsTimesOfImpact, showsSeparations,
  showsWhichTimesAreLate, namesEveryStripOfTimes, showsSweeps, showsASingleValueBesideASweep,
  showsSweepsOfWhatIsNeverWrong, showsSubjectsWithTheNamesOfMembers, showsValuesOfOptions,
  showsAClaimOfNoDistanceThatIsRefuted, showsScenes, showsSceneStepsAndMeshes, showsSimulations,
  showsTheLadderAndTheAudit, showsWhatDecides, showsAChoiceOfManySubjects, drawsManySubjectsWithoutALadder,
  drawsAMixOfRuns, showsWhatIsBeyondAContract, showsThePowerOfDetection, showsEnvironments,
  showsWhereCollisionsAreMissed, answersBeforeScrolling, fitsEveryMedium, staysQuickWithManyFindings,
  hasNoBarriers,
];

try {
  for (const test of tests) {
    await test(browser);
    for (const context of browser.contexts()) await context.close(); // with the test's pages
  }
  everyReportFollowsItsSchema();
} finally {
  await browser.close();
  removeFolder();
}
