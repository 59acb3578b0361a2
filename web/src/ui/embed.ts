/**
 * What a page that shows the walk in a frame, and the walk, tell each other by postMessage. Every message has `acentric: 1`,
 * the version of this interface (docs/web.md). Angles are degrees, places metres.
 */

import type { Walk } from '../walk';

const kVersion = 1;
const degrees = (radians: number) => (radians * 180) / Math.PI;
const radians = (value: unknown) => (typeof value === 'number' && Number.isFinite(value) ? (value * Math.PI) / 180 : 0);

export class Embedding {
  private last = '';

  constructor(private readonly walk: Walk) {
    if (window.parent === window) return;
    window.addEventListener('message', ({ source, data }: MessageEvent<unknown>) => {
      if (source === window.parent && typeof data === 'object' && data !== null) this.obey(data as { [key: string]: unknown });
    });
    const { name, bookmarks, paths, storeys } = walk.bundle;
    const names = (list: readonly { name: string }[]) => list.map((one) => one.name);
    this.tell({ event: 'ready', name, storeys: names(storeys), bookmarks: names(bookmarks), paths: names(paths) });
  }

  private tell(message: object): void {
    window.parent.postMessage({ acentric: kVersion, ...message }, '*'); // nothing in it is a secret
  }

  private obey(message: { [key: string]: unknown }): void {
    const { walk } = this, { bookmarks, paths, storeys } = walk.bundle;
    if (message.acentric !== kVersion) return;
    if (message.do === 'go' && Array.isArray(message.eye) && message.eye.slice(0, 2).every((value) => Number.isFinite(value))) {
      const [x, y] = message.eye as [number, number];
      const storey = Number.isInteger(message.storey) && storeys[message.storey as number] ? (message.storey as number) : walk.storey;
      walk.go({ eye: [x, y, 0], yaw: radians(message.yaw), pitch: radians(message.pitch) }, storey);
    } else if (message.do === 'bookmark') {
      const bookmark = bookmarks.find(({ name }) => name === message.name);
      if (bookmark) walk.go(bookmark, bookmark.storey);
    } else if (message.do === 'play') {
      const path = paths.find(({ name }) => name === message.name);
      if (path) walk.play(path);
    } else if (message.do === 'stop') {
      walk.stop();
    }
  }

  /** After a frame; only what has changed is told. */
  drawn(): void {
    if (window.parent === window) return;
    const { eye, yaw, pitch } = this.walk.pose;
    const view = { event: 'view', eye, yaw: degrees(yaw), pitch: degrees(pitch), storey: this.walk.storey };
    const text = JSON.stringify(view);
    if (text !== this.last) this.tell(view);
    this.last = text;
  }
}
