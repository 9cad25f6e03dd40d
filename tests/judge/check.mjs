// Every defect of the list applies to the sources as they are, and changes them.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { source } from './copy.mjs';
import { applied, readDefects } from './list.mjs';

const defects = readDefects();
for (const defect of defects) {
  const text = readFileSync(path.join(source, defect.file), 'utf8');
  if (applied(defect, text) === text) throw new Error(`${defect.name} changes nothing`);
}
console.log(`${defects.length} defects apply`);
