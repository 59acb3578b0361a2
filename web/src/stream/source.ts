/** Where the files of a bundle are: in a folder, or in a walk. */

import type { FileRef } from '../bundle/types';
import { rangesOf, WalkFile, type WalkPage } from '../bundle/walk_file';

export interface Source {
  /** Where a file begins in the walk that holds all of them; undefined: it is one itself. */
  from(file: FileRef): number | undefined;
  text(file: string): Promise<string>;
  /** Absolute address of a file; undefined: `bytes` has it. */
  url(file: string): string | undefined;
  bytes(file: string): Uint8Array | undefined;
}

export function decodedBase64(base64: string): Uint8Array {
  const text = atob(base64);
  return Uint8Array.from({ length: text.length }, (_, i) => text.charCodeAt(i));
}

/** Files of their own, in a folder of a host. */
export class FolderSource implements Source {
  constructor(private readonly folder: string) {} // absolute address, or of a file within it

  async text(file: string): Promise<string> {
    let response: Response;
    try {
      response = await fetch(this.url(file));
    } catch {
      throw new Error(
        location.protocol === 'file:'
          ? `${file}: browsers do not let pages that are opened as files read others. Serve this folder with any web server, ` +
            'or export with --single-file.'
          : `${file}: the server does not answer`,
      );
    }
    if (!response.ok) throw new Error(`${file}: the server answers ${response.status}`);
    return response.text();
  }
  url = (file: string) => new URL(file, this.folder).href;
  bytes = () => undefined;
  from = () => undefined;
}

/** One file that is read by ranges. */
export class WalkSource implements Source {
  private constructor(private readonly address: string, readonly walk: WalkFile, readonly first: WalkPage) {}

  static async open(address: string): Promise<WalkSource> {
    try {
      const walk = await WalkFile.open(rangesOf(address));
      return new WalkSource(address, walk, await walk.firstPage());
    } catch (error) {
      throw new Error(`${address}: ${(error as Error).message}`);
    }
  }
  text = (): Promise<string> => Promise.resolve(this.first.text);
  url = () => this.address;
  bytes = () => undefined;
  from = ({ at }: FileRef) => (at === undefined ? undefined : this.walk.dataStart + at);
}
