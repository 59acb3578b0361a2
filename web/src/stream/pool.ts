/** Workers that load files. */

import type { FileRef } from '../bundle/types';
import type { Answer, Loaded, Request, Start, Task } from './messages';
import type { Source } from './source';
import LoaderWorker from './worker?worker&inline';

/** So many files at once for each worker: one comes while another is unpacked. */
const kEach = 2;

export class LoaderPool {
  private readonly workers: { worker: Worker; busy: number }[] = [];
  private readonly waiting = new Map<number, { resolve: (loaded: Loaded) => void; reject: (error: Error) => void }>();
  private next = 0;
  /** A file has come, and another may be asked for. */
  onRoom: () => void = () => undefined;

  constructor(private readonly source: Source, { module, index }: Start, count: number) {
    for (let i = 0; i < count; ++i) {
      const entry = { worker: new LoaderWorker(), busy: 0 };
      entry.worker.onmessage = (event: MessageEvent<Answer>) => {
        --entry.busy;
        const waiting = this.waiting.get(event.data.id);
        this.waiting.delete(event.data.id);
        if ('loaded' in event.data) waiting?.resolve(event.data.loaded);
        else waiting?.reject(new Error(event.data.error));
        setTimeout(() => this.onRoom()); // once whoever waited has dealt with it
      };
      entry.worker.postMessage({ module, index } satisfies Start);
      this.workers.push(entry);
    }
  }

  get room(): number {
    return this.workers.reduce((sum, entry) => sum + Math.max(0, kEach - entry.busy), 0);
  }

  /** What is under way never comes. */
  close(): void {
    for (const { worker } of this.workers) worker.terminate();
  }

  load(task: Task, file: FileRef, again: boolean): Promise<Loaded> {
    const entry = this.workers.reduce((least, other) => (other.busy < least.busy ? other : least));
    ++entry.busy;
    const id = this.next++;
    const bytes = this.source.bytes(file.file);
    const request: Request = { id, task, file, url: this.source.url(file.file), from: this.source.from(file), bytes, again };
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      entry.worker.postMessage(request, bytes ? [bytes.buffer] : []);
    });
  }
}
