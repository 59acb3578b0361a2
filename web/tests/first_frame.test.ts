import { expect, it } from 'vitest';
import { reportOfFirstFrame } from '../src/first_frame';

it('tells of the first frame only where the address asks for it', () => {
  expect(reportOfFirstFrame('?report', 1234.6)).toBe('/.acentric/first-frame?ms=1235');
  expect(reportOfFirstFrame('?walk=a.acentric&report', 20)).toBe('/.acentric/first-frame?ms=20');
  for (const query of ['', '?walk=report', '?walk=a.acentric']) expect(reportOfFirstFrame(query, 20)).toBeUndefined();
});
