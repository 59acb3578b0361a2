/** What all files of a bundle have in common. */

import { xxhash128 } from 'hash-wasm';
import { ZSTDDecoder } from 'zstddec';

/** What is wrong with a file, in a sentence without its name. */
export class DamagedFile extends Error {}

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
