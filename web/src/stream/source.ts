/** Where the bundle's files are: beside the page, within it (export --single-file), or in a walk. */

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

/** Elements of a page that holds its bundle: <script type="application/octet-stream" data-file="NAME">base64</script>. */
const elementOf = (file: string) => document.querySelector(`script[data-file="${CSS.escape(file)}"]`);

export function decodedBase64(base64: string): Uint8Array {
  const text = atob(base64);
  return Uint8Array.from({ length: text.length }, (_, i) => text.charCodeAt(i));
}

class WithinPage implements Source {
  text = async (file: string) => new TextDecoder().decode(this.bytes(file));
  url = () => undefined;
  from = () => undefined;
  bytes(file: string): Uint8Array {
    const element = elementOf(file);
    return element ? decodedBase64((element.textContent ?? '').trim()) : new Uint8Array(0);
  }
}

class BesidePage implements Source {
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
  url = (file: string) => new URL(file, document.baseURI).href;
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

/** The walk that the page's address names (?walk=FILE), or the bundle within the page or beside it. */
export async function sourceFor(index: string): Promise<Source> {
  const walk = new URLSearchParams(location.search).get('walk');
  if (walk !== null) return WalkSource.open(new URL(walk, document.baseURI).href);
  return elementOf(index) ? new WithinPage() : new BesidePage();
}
