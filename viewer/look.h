// A way of looking at the subject: its lights, the reflectances put in place of the scene's own, the
// observer. A comparison has two.
#pragma once

#include "camera/film.h"
#include "colour/observe.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace spectrad::view {

struct LightSetting {
    std::string name;  ///< "lamp", or "light 2" where the scene gives none
    Emitter emitter;   ///< as the scene has it, or with another spectrum
    double times = 1;  ///< of the scene's amount
    bool on = true;
};

struct Look {
    std::vector<LightSetting> lights;            ///< one for each light of the scene, in its order
    std::map<Index, Spectrum> reflectances;      ///< of materials whose <diffuse> reflectance is another
    std::shared_ptr<const Eye> eye;              ///< in front of a film the layers, X Y Z their channels
    std::shared_ptr<const FilmProjection> film;  ///< nothing for an eye or a camera
    std::uint64_t version = 0;                   ///< another number after each change
};

}  // namespace spectrad::view
