/** What a viewer can set; kept in the browser where it allows that. */

import { memoryOfDevice } from './device';

export interface Settings {
  quality: 'full' | 'coarse';
  scale: number; // of the resolution, 0.25..1
  fov: number; // degrees, of the picture's longer side
  memory: number; // MB of captures on the graphics card
  map: boolean;
  holes: boolean;
}

const kName = 'acentric-walk';

export function loadSettings(fov: number): Settings {
  const standard: Settings = {
    quality: 'full', scale: 1, fov: Math.round(fov), holes: false, map: true, memory: memoryOfDevice(),
  };
  try {
    const kept = JSON.parse(localStorage.getItem(kName) ?? '{}') as Partial<Settings>;
    for (const key of Object.keys(standard) as (keyof Settings)[])
      if (typeof kept[key] === typeof standard[key] && key !== 'holes' && (key !== 'quality' || kept.quality === 'coarse')) Object.assign(standard, { [key]: kept[key] });
  } catch {
    // Nothing is kept: private windows, pages opened as files.
  }
  return standard;
}

export function keepSettings(settings: Settings): void {
  try {
    localStorage.setItem(kName, JSON.stringify(settings));
  } catch {
    // As above.
  }
}
