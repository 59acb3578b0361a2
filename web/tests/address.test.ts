import { describe, expect, it } from 'vitest';
import { addressOf, parseAddress } from '../src/address';

describe('an address', () => {
  it('leads back to its view, on its storey', () => {
    for (const storey of [0, 1, 2]) {
      const address = addressOf([1.25, -3.5, 1.6], 1, -0.2, storey, 1);
      expect(address.includes('storey')).toBe(storey !== 1);
      const view = parseAddress(address, 3, 1)!;
      expect(view.eye).toEqual([1.25, -3.5]);
      expect(view.yaw).toBeCloseTo(1, 2);
      expect(view.pitch).toBeCloseTo(-0.2, 2);
      expect(view.storey).toBe(storey);
    }
  });

  it('leads to a view as the editor writes it', () => {
    expect(parseAddress('#at=1.25,-3.50,-0.0,-5.0&storey=0', 1, 0)).toEqual({ eye: [1.25, -3.5], yaw: -0, pitch: (-5 * Math.PI) / 180, storey: 0 });
  });

  it.each(['', '#at=1,2,3', '#at=1,2,3,4,5', '#at=1,2,3,4&storey=3', '#at=1,2,3,4&storey=-1', '#at=1.2.3,2,3,4', '#at=1,2,3,x'])(
    'that tells none is none: "%s"', (hash) => expect(parseAddress(hash, 3, 0)).toBeUndefined(),
  );
});
