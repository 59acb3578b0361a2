/** A page that was opened with ?report tells the server that it came from when its first picture was there. */

/** Undefined unless the page's address, whose query this is, asks for that. */
export function reportOfFirstFrame(query: string, milliseconds: number): string | undefined {
  return new URLSearchParams(query).has('report') ? `/.acentric/first-frame?ms=${Math.round(milliseconds)}` : undefined;
}
