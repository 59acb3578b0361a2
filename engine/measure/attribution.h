#pragma once
/// What the error of a frame comes from. Every pixel is laid to one source; were that source switched off,
/// its pixels would be those of the truth. Errors are squared differences of sRGB codes (0..255), summed over
/// red, green and blue, as PSNR counts them.

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/image/image.h"
#include "engine/view/frame.h"

namespace acentric {

/// A pixel that is of several is laid to the first.
enum class ErrorSource : std::uint8_t {
  holes,          ///< no camera holds what is there: missing layers, filled on the screen or not
  silhouettes,    ///< the truth shows an edge between surfaces there: where samples of both meet
  seams,          ///< beside the border between local polygons and captures
  viewDependent,  ///< metals, mirrors and glass: lit for the camera's eye
  polygons,       ///< local polygons: light kept at texels, simplification
  background,     ///< the sky
  resampling,     ///< captured surfaces: their samples, distances and reconstruction
};
inline constexpr std::size_t kErrorSources = 7;
const char* nameOf(ErrorSource source);
const char* wordsFor(ErrorSource source);  ///< for people: "captured surfaces"

/// Sums over a frame, or over many.
struct Attribution {
  struct Part {
    std::size_t pixels = 0;
    double squares = 0;
  };
  std::array<Part, kErrorSources> parts{};

  const Part& of(ErrorSource source) const { return parts[std::size_t(source)]; }
  std::size_t pixels() const;
  double squares() const;
  /// Of the whole error; 0 where there is none.
  double share(ErrorSource source) const;
  /// dB of all frames as one picture; 99 where there is no error.
  double psnr() const;
  /// The same with that source switched off.
  double psnrWithout(ErrorSource source) const;
  Attribution& operator+=(const Attribution& other);
};

/// All of one size. `truthDistance`: metres along the ray, infinity where there is no surface;
/// `viewDependent`: not 0 where what is seen looks different from elsewhere.
Attribution attribute(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance,
                      const Image<std::uint8_t>& viewDependent);

/// The truth as samples `pixelsPerSample` (>= 1) pixels apart could tell it at best: each the mean of the
/// square that it stands for, sharpened (image/sharpen.h) and drawn bilinearly. What it lacks, no patches of
/// captures that coarse can show.
ColourImage atSampleRate(const ColourImage& truth, double pixelsPerSample);

}  // namespace acentric
