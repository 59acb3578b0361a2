/** Opens what a source holds: its index, the workers that load its files, and the planner of frames. */

import moduleSource from '../../build/page/page.wasm?inline';
import { kIndexName, readIndex } from './bundle/read_index';
import type { Bundle } from './bundle/types';
import { Planner } from './engine/planner';
import { LoaderPool } from './stream/pool';
import { decodedBase64, WalkSource, type Source } from './stream/source';

export interface OpenWalk {
  bundle: Bundle;
  pool: LoaderPool;
  planner: Planner;
  source: WalkSource | undefined; // of a walk, whose index has pages
}

/** `threads`: workers. */
export async function openWalk(source: Source, threads: number): Promise<OpenWalk> {
  const module = await WebAssembly.compile(decodedBase64(moduleSource.slice(moduleSource.indexOf(',') + 1)) as BufferSource);
  const index = await source.text(kIndexName);
  const bundle = readIndex(index);
  return {
    bundle, planner: new Planner(module, index), pool: new LoaderPool(source, { module, index }, threads),
    source: source instanceof WalkSource ? source : undefined,
  };
}
