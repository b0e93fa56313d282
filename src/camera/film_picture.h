// A film's picture: exposed as a light meter says, developed, and looked at in its projector.
#pragma once

#include "camera/film.h"
#include "colour/observe.h"
#include "colour/white.h"

#include <string>
#include <vector>

namespace spectrad {

/// What the light meter says of an image of the layers' channels: the luminance that counts as white. That of
/// `white` if it has one ("X,Y,Z", "at:X,Y"), else the 99th percentile, both through the green layer.
[[nodiscard]] double meteredBy(const FilmProjection& film, const ChannelImage& channels,
                               const std::string& white);
/// X Y Z of the transparency in its projector, the lamp without film at Y = 100, of the layers' channels.
/// `stops` of exposure more.
[[nodiscard]] Triple projected(const FilmProjection& film, const std::vector<double>& channels,
                               double metered, double stops);
[[nodiscard]] ChannelImage projected(const FilmProjection& film, ChannelImage channels, double metered,
                                     double stops);
/// Who looks at a projection is adapted to its lamp, and takes the clearest film for white.
[[nodiscard]] White projectionWhite(const FilmProjection& film);

}  // namespace spectrad
