#include "engine/bake/chunk_samples.h"

#include <array>
#include <functional>

namespace acentric {
namespace {

/// One of the lists of all chunks. Its arrays are filled side by side: they are too large for any cache, and
/// one thread would not use the memory's whole rate.
template <class ListOf>
void join(const std::vector<ChunkSamples>& chunks, const ListOf& listOf, TaskRunner& runner,
          const std::stop_token& stop, CaptureSamples& out) {
  std::size_t columns = 0;
  for (const ChunkSamples& chunk : chunks) columns += listOf(chunk).perColumn.size();
  const auto fill = [&](auto& all, auto SampleList::*part) {
    std::size_t total = 0;
    for (const ChunkSamples& chunk : chunks) total += (listOf(chunk).*part).size();
    all.reserve(total);
    for (const ChunkSamples& chunk : chunks) {
      if (stop.stop_requested()) return;
      const auto& some = listOf(chunk).*part;
      all.insert(all.end(), some.begin(), some.end());
    }
  };
  const auto starts = [&] {
    out.columnStart.reserve(columns + 1);
    out.columnStart.push_back(0);
    for (const ChunkSamples& chunk : chunks)
      for (const std::uint32_t count : listOf(chunk).perColumn)
        out.columnStart.push_back(out.columnStart.back() + count);
  };
  const auto onPlanes = [&] {
    fill(out.plane, &SampleList::plane);
    std::size_t at = 0;
    std::uint32_t before = 0;
    for (const ChunkSamples& chunk : chunks) {
      const SampleList& list = listOf(chunk);
      for (std::size_t i = 0; i < list.plane.size() && at < out.plane.size(); ++i) out.plane[at++] += before;
      before += std::uint32_t(list.planes.size());
    }
    out.coverage.assign(out.plane.size(), kWholePixel);
  };
  const std::array<std::function<void()>, 8> parts{
      [&] { fill(out.colour, &SampleList::colour); },
      [&] { fill(out.inverseDistance, &SampleList::inverseDistance); },
      [&] { fill(out.row, &SampleList::row); },
      [&] { fill(out.roles, &SampleList::roles); },
      [&] { fill(out.mirror, &SampleList::mirror); },
      onPlanes,
      [&] { fill(out.planes, &SampleList::planes); },
      starts};
  runner.parallelFor(parts.size(), [&](std::size_t part) { parts[part](); });
}

}  // namespace

void SampleList::reserve(std::size_t samples) {
  row.reserve(samples);
  inverseDistance.reserve(samples);
  colour.reserve(samples);
  roles.reserve(samples);
}

void SampleList::trim() {
  if (2 * row.size() > row.capacity()) return;
  row.shrink_to_fit();
  inverseDistance.shrink_to_fit();
  colour.shrink_to_fit();
  roles.shrink_to_fit();
  mirror.shrink_to_fit();
  plane.shrink_to_fit();
  planes.shrink_to_fit();
}

void ChunkSamples::close() {
  trim();
  reflections.trim();
  held.set(kBytes * (heldSamples() + reflections.heldSamples()));
}

Capture joined(const std::vector<ChunkSamples>& chunks, bool reflections, TaskRunner& runner,
               const std::stop_token& stop) {
  Capture capture;
  const auto surfaces = [](const ChunkSamples& s) -> const SampleList& { return s; };
  const auto shown = [](const ChunkSamples& s) -> const SampleList& { return s.reflections; };
  join(chunks, surfaces, runner, stop, capture);
  BackgroundBuilder background;
  for (const ChunkSamples& chunk : chunks) background.append(chunk.background);
  capture.background = std::move(background).finish({});
  if (reflections)
    join(chunks, shown, runner, stop, capture.reflections);
  else
    capture.mirror = {};  // a mirror that shows nothing to anybody is a surface like others
  return capture;
}

}  // namespace acentric
