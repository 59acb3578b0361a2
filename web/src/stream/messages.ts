/** What the page and its workers tell each other. */

import type { LocalGeometry } from '../engine/local_reader';
import type { Capture } from '../engine/pack_reader';
import type { FileRef } from '../bundle/types';
import type { Vec3 } from '../geometry/vector';

export type Task =
  | { kind: 'capture'; exposure: number }
  | { kind: 'local'; origin: Vec3 }
  | { kind: 'texture'; width: number; height: number };

/** Before all requests: the engine's module, and bundle.json. */
export interface Start {
  module: WebAssembly.Module;
  index: string;
}

export interface Request {
  id: number;
  task: Task;
  file: FileRef;
  url: string | undefined; // absolute; undefined: `bytes` has the file
  from: number | undefined; // of a walk: where the file begins in it
  bytes: Uint8Array | undefined;
  again: boolean; // past what caches say
}

export type Loaded = { kind: 'capture'; capture: Capture } | { kind: 'local'; local: LocalGeometry } | { kind: 'texture'; picture: ImageBitmap };

export type Answer = { id: number; loaded: Loaded } | { id: number; error: string };
