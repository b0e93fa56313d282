#include "camera/film_picture.h"

#include "colour/develop.h"
#include "colour/image_white.h"

#include <utility>

namespace spectrad {

double meteredBy(const FilmProjection& film, const ChannelImage& channels, const std::string& white) {
    if (isPlace(white)) return film.metered(whiteOfImage(white, channels).xyz[1]);
    if (const std::optional<Triple> stated = parseXyz(white)) return (*stated)[1];
    std::vector<double> green = channels.plane[1];
    const double light = green.empty() ? 0 : film.metered(quantile(green, exposedQuantile));
    return light > 0 ? light : 1;
}

Triple projected(const FilmProjection& film, const std::vector<double>& channels, double metered,
                 double stops) {
    const Triple exposures = film.exposures(channels, metered, stops);
    return diagonal({diffuserY, diffuserY, diffuserY}) * film.xyz(film.densities(exposures));
}

ChannelImage projected(const FilmProjection& film, ChannelImage channels, double metered, double stops) {
    std::vector<double> pixel(3);
    for (size_t i = 0; i < channels.pixels(); ++i) {
        for (size_t k = 0; k < 3; ++k)
            pixel[k] = channels.plane[k][i];
        const Triple seen = projected(film, pixel, metered, stops);
        for (size_t k = 0; k < 3; ++k)
            channels.plane[k][i] = seen[k];
    }
    return channels;
}

White projectionWhite(const FilmProjection& film) {
    const CharacteristicCurve* curves = film.film().curves.data();
    const double clear = film.xyz({curves[0].dmin, curves[1].dmin, curves[2].dmin})[1];
    return withLuminance({film.film().projectorName, film.lamp(), false}, diffuserY * clear);
}

}  // namespace spectrad
