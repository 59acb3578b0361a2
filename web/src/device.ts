/** What the browser tells of the device that it runs on. Few tell all of it. */

/** Did the user ask the browser to save data? */
export const savesData = (): boolean => (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;

/** Workers to load files: a processor is left to the page. */
export const threadsOfDevice = (): number => Math.max(1, Math.min(4, (navigator.hardwareConcurrency || 2) - 1));

/** MB of captures on the graphics card. */
export function defaultMemory(deviceGigabytes: number | undefined, smallScreen: boolean): number {
  const share = 128 * (deviceGigabytes ?? (smallScreen ? 3 : 8));
  return Math.min(smallScreen ? 512 : 2048, Math.max(256, Math.round(share / 64) * 64));
}
export const memoryOfDevice = (): number =>
  defaultMemory((navigator as { deviceMemory?: number }).deviceMemory, Math.min(screen.width, screen.height) < 700);
