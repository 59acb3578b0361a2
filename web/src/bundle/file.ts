/** What all files of a bundle have in common. */

import { xxhash128 } from 'hash-wasm';
import { ZSTDDecoder } from 'zstddec';

/** What is wrong with a file, in a sentence without its name. */
export class DamagedFile extends Error {}

/** A file, or `bytes` of it from `at` on. `again`: past what caches say. */
export async function fetched(url: string, again: boolean, part?: { at: number; bytes: number }): Promise<Response> {
  const headers = part && { Range: `bytes=${part.at}-${part.at + part.bytes - 1}` };
  let response: Response;
  try {
    response = await fetch(url, { cache: again ? 'reload' : 'default', headers });
  } catch {
    throw new DamagedFile('the server does not answer');
  }
  if (response.status === 404) throw new DamagedFile('it is missing on the server');
  if (part && response.status === 200) {
    void response.body?.cancel();
    throw new DamagedFile('the server does not send parts of files (HTTP range requests)');
  }
  if (!response.ok) throw new DamagedFile(`the server answers ${response.status}`);
  return response;
}

let decoder: Promise<ZSTDDecoder> | undefined;
export function zstd(): Promise<ZSTDDecoder> {
  decoder ??= (async () => {
    const made = new ZSTDDecoder();
    await made.init();
    return made;
  })();
  return decoder;
}

/** XXH3 with 128 bits and seed 0, as 32 hexadecimal digits, high half first. */
export const contentHash = (bytes: Uint8Array): Promise<string> => xxhash128(bytes, 0, 0);

/** Makes ready what the first file needs. */
export async function warmUp(): Promise<void> {
  await Promise.all([zstd(), contentHash(new Uint8Array(1))]);
}
