/** A worker: requests in, answers out, their arrays handed over instead of copied. */

import { warmUp, zstd } from '../bundle/file';
import { LocalReader } from '../engine/local_reader';
import { PackReader } from '../engine/pack_reader';
import { loadFile, type Readers } from './load_file';
import type { Answer, Loaded, Request, Start } from './messages';

function handedOver(value: unknown, found = new Set<Transferable>()): Set<Transferable> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (value instanceof ArrayBuffer || value instanceof ImageBitmap) found.add(value);
  else if (typeof value === 'object' && value !== null) Object.values(value).forEach((inner) => handedOver(inner, found));
  return found;
}

const answer = (message: Answer, loaded?: Loaded) => self.postMessage(message, { transfer: [...handedOver(loaded)] });

let readers: Promise<Readers>;

self.onmessage = ({ data }: MessageEvent<Start | Request>) => {
  if ('module' in data) {
    readers = zstd().then((zstandard) => ({
      packs: new PackReader(data.module, zstandard), locals: new LocalReader(data.module, zstandard, data.index),
    }));
    return;
  }
  const { id } = data;
  loadFile(data, readers).then(
    (loaded) => answer({ id, loaded }, loaded),
    (error: unknown) => answer({ id, error: error instanceof Error ? error.message : String(error) }),
  );
};

void warmUp();
