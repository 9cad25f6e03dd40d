// Checks that every defect of the list applies to the current sources, and changes them.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { source } from './copy.mjs';
import { applied, readDefects } from './list.mjs';

/** The fault of a defect, or nothing. */
function complaint(defect) {
  const text = readFileSync(path.join(source, defect.file), 'utf8');
  try {
    return applied(defect, text) === text ? `${defect.name}: changes nothing` : undefined;
  } catch (error) {
    return error.message;
  }
}

const defects = readDefects();
const complaints = defects.map(complaint).filter(Boolean);
for (const each of complaints) console.error(each);
console.log(`${defects.length - complaints.length} of ${defects.length} defects apply`);
process.exitCode = complaints.length > 0 ? 1 : 0;
