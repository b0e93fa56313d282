#include "viewer/wish.h"

#include <fmt/format.h>

namespace spectrad::view {

bool same(const Pose& a, const Pose& b) {
    const auto equal = [](Vec3 p, Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
    return equal(a.eye, b.eye) && equal(a.target, b.target) && equal(a.up, b.up) &&
           a.pixelsPerSlopeOverHeight == b.pixelsPerSlopeOverHeight && a.orthographic == b.orthographic;
}

Display Wish::displayFor(const Look& look, const Detector& standard) const {
    if (!primaries) return codes;
    return primaries->seenBy(look.eye->detector.tristimulus ? look.eye->detector : standard);
}

std::string Wish::key() const {
    const bool two = mode != Mode::single;
    std::string key = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(mode), looks[0].version,
        two ? looks[1].version : 0, static_cast<int>(adaptation), white, display, heldLuminance.value_or(0),
        ev, mode == Mode::mixture ? mix : 0, mode == Mode::difference ? differenceTop : 0, degree,
        static_cast<int>(tone), static_cast<int>(mapping), static_cast<int>(picture), bands.bands[0],
        bands.bands[1], bands.bands[2]);
    const Pose& pose = stand.pose;
    for (const Vec3& v : {pose.eye, pose.target, pose.up})
        key += fmt::format(" {} {} {}", v.x, v.y, v.z);
    return key + fmt::format(" {} {} {} {}", pose.pixelsPerSlopeOverHeight, stand.width, stand.height,
                             stand.samples.value_or(0));
}

}  // namespace spectrad::view
