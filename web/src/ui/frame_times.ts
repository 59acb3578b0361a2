/** Frame times of the last second. */

export class FrameTimes {
  private frames: { at: number; took: number }[] = [];

  add(at: number, took: number): void {
    this.frames.push({ at, took });
    this.frames = this.frames.filter((frame) => at - frame.at <= 1000);
  }

  /** Milliseconds; undefined before the first frame. */
  get summary(): { median: number; worst: number; count: number } | undefined {
    if (this.frames.length === 0) return undefined;
    const sorted = this.frames.map((frame) => frame.took).sort((a, b) => a - b);
    return { median: sorted[Math.floor(sorted.length / 2)], worst: sorted[sorted.length - 1], count: sorted.length };
  }
}
