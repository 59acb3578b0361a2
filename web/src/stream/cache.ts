/** What is loaded, within a limit of memory. Eviction takes what the eye is farthest from; what the picture needs stays. */

import { keyOf, type Item, type Name } from './wanted';

export interface Entry<Value> {
  item: Item;
  value: Value;
  bytes: number;
}

export class Cache<Value> {
  private readonly entries = new Map<string, Entry<Value>>();
  private sum = 0;

  constructor(private readonly drop: (value: Value) => void) {}

  get bytes(): number {
    return this.sum;
  }
  get size(): number {
    return this.entries.size;
  }
  get(item: Name): Value | undefined {
    return this.entries.get(keyOf(item))?.value;
  }
  has(item: Name): boolean {
    return this.entries.has(keyOf(item));
  }
  values(): Value[] {
    return [...this.entries.values()].map((entry) => entry.value);
  }

  add(item: Item, value: Value, bytes: number): void {
    this.remove(item);
    this.entries.set(keyOf(item), { item, value, bytes });
    this.sum += bytes;
  }

  remove(item: Name): void {
    const entry = this.entries.get(keyOf(item));
    if (!entry) return;
    this.entries.delete(keyOf(item));
    this.sum -= entry.bytes;
    this.drop(entry.value);
  }

  clear(): void {
    for (const entry of [...this.entries.values()]) this.remove(entry.item);
  }

  /**
   * Which of the wanted items, most urgent first, fit into the limit, and drops what does not belong to them once room is
   * short. `bytesOf` foretells what an item that is not there will take, `distanceOf` says how far from the eye it belongs.
   * The first `needed` items are the picture's: they are kept even beyond the limit.
   */
  plan(
    wanted: readonly Item[], needed: number, limit: number, bytesOf: (item: Item) => number, distanceOf: (item: Item) => number,
  ): Item[] {
    const kept = new Set<string>();
    const missing: Item[] = [];
    let room = limit;
    for (let n = 0; n < wanted.length; ++n) {
      const item = wanted[n], entry = this.entries.get(keyOf(item));
      const bytes = entry ? entry.bytes : bytesOf(item);
      if (n >= needed && bytes > room) break; // nothing farther in the place of something nearer
      room -= bytes;
      kept.add(keyOf(item));
      if (!entry) missing.push(item);
    }
    // Of the others the nearest stay while there is room.
    const others = [...this.entries.values()].filter((entry) => !kept.has(keyOf(entry.item)));
    others.sort((a, b) => distanceOf(a.item) - distanceOf(b.item));
    for (const entry of others) {
      if (entry.bytes <= room) room -= entry.bytes;
      else this.remove(entry.item);
    }
    return missing;
  }
}
