/** The panel of settings. */

import type { Settings } from '../settings';
import type { Walk } from '../walk';

export const element = <Kind extends HTMLElement = HTMLElement>(id: string): Kind => document.getElementById(id) as Kind;

const megabytes = (bytes: number): string => (bytes >= 1e9 ? `${(bytes / 1e9).toFixed(2)} GB` : `${Math.round(bytes / 1e6)} MB`);

export class SettingsPanel {
  private readonly refresh: (() => void)[] = [];

  constructor(private readonly walk: Walk, changed: () => void) {
    const { settings } = walk;
    const quality = element<HTMLSelectElement>('set-quality');
    quality.addEventListener('change', () => {
      settings.quality = quality.value as Settings['quality'];
      changed();
    });
    this.refresh.push(() => (quality.value = settings.quality));
    const range = (name: string, get: () => number, set: (value: number) => void, text: (value: number) => string) => {
      const input = element<HTMLInputElement>(`set-${name}`);
      input.addEventListener('input', () => {
        set(Number(input.value));
        changed();
      });
      this.refresh.push(() => {
        input.value = String(get());
        element(`out-${name}`).textContent = text(get());
      });
    };
    range('scale', () => Math.round(100 * settings.scale), (v) => (settings.scale = v / 100), (v) => `${v} %`);
    range('fov', () => settings.fov, (v) => (settings.fov = v), (v) => `${v}°`);
    range('memory', () => settings.memory, (v) => (settings.memory = v), (v) => megabytes(v * 1e6));
    this.places();
    this.show();
  }

  /** Starts of the storeys, bookmarks, and paths to walk along. */
  private places(): void {
    const { walk } = this, select = element<HTMLSelectElement>('set-view');
    const places: { name: string; go: () => void }[] = walk.bundle.storeys.map((storey, number) => ({
      name: walk.bundle.storeys.length > 1 ? `the start of ${storey.name}` : 'the start',
      go: () => walk.go({ eye: [...storey.start.position, storey.eyeZ], yaw: storey.start.yaw, pitch: 0 }, number),
    }));
    for (const bookmark of walk.bundle.bookmarks) places.push({ name: bookmark.name, go: () => walk.go(bookmark, bookmark.storey) });
    for (const path of walk.bundle.paths) places.push({ name: `▶ ${path.name}`, go: () => walk.play(path) });
    select.append(new Option('…', ''));
    places.forEach((place, number) => select.append(new Option(place.name, String(number))));
    select.addEventListener('change', () => {
      if (select.value !== '') places[Number(select.value)].go();
      select.value = '';
    });
  }

  show(): void {
    this.refresh.forEach((one) => one());
    const { drawing, bytes, loading } = this.walk;
    element('loaded').textContent =
      `${megabytes(bytes)} loaded${loading > 0 ? `, ${loading} files on their way` : ''}; drawn at ${drawing.width} × ${drawing.height}`;
  }
}
