#pragma once
/// What capture files as OpenEXR hold (FORMAT.md, "Captures as OpenEXR").

#include <OpenEXR/ImfHeader.h>

#include <vector>

#include "engine/base/hash.h"
#include "engine/image/capture.h"

namespace acentric {

inline constexpr int kCaptureExrVersion = 4;
/// Value of channel W where a flat file's pixel has no sample.
inline constexpr float kNoDistance = -1.0f;

/// Who needs a sample: bit r for role r.
inline constexpr char kRolesChannel[] = "roles";
/// Which mirror a surface belongs to, or shows what a reflection is of. Only in files with reflections.
inline constexpr char kMirrorChannel[] = "mirror";
/// Parts of a file with reflections; one without has a single part, without a name.
inline constexpr char kSurfacesPart[] = "surfaces";
inline constexpr char kReflectionsPart[] = "reflections";
inline constexpr char kAttributeVersion[] = "acentricVersion";
inline constexpr char kAttributeKey[] = "acentricKey";
inline constexpr char kAttributeChecksum[] = "acentricChecksum";
inline constexpr char kAttributeCentre[] = "acentricCentreOfProjection";
inline constexpr char kAttributeLowAzimuth[] = "acentricLowAzimuth";
inline constexpr char kAttributeFov[] = "acentricFov";
inline constexpr char kAttributeTop[] = "acentricTopElevation";
inline constexpr char kAttributeBottom[] = "acentricBottomElevation";
inline constexpr char kAttributeStep[] = "acentricDistanceStep";
/// Only in files of captures that show it.
inline constexpr char kAttributeZenith[] = "acentricSkyZenith";
inline constexpr char kAttributeHorizon[] = "acentricSkyHorizon";
inline constexpr char kAttributeGround[] = "acentricSkyGround";

/// OpenEXR's convention is premultiplied colour, ours is straight. Exact for alpha 1; else rounded to the
/// nearest half.
HalfColour premultiplied(const HalfColour& straight);

/// The samples of a picture: in the background there is one more, infinitely far and opaque. Colours are
/// premultiplied.
CaptureSamples withBackground(const Capture& capture, std::vector<HalfColour> premultipliedColours);

/// Guards what the compression's own check does not: attributes, sample counts, the order of samples.
/// Reflections are opaque: their colours are the same premultiplied.
ContentKey checksumOf(const ContentKey& key, const Capture& capture,
                      const std::vector<HalfColour>& premultipliedColours);

}  // namespace acentric
