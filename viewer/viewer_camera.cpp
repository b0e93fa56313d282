// The camera at the hands of the user: orbit, pan, dolly, fly, frame.
#include "viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad::view {

void Viewer::moveTo(const Pose& pose) {
    session_.stand.pose = pose;
    settled_ = false;
    samples_ = 1;
}

void Viewer::toHome() {
    place_.reset();
    placed_ = false;
    if (session_.aboutScene()) moveTo(session_.aboutScene()->home());
}

void Viewer::frameAll() {
    if (!session_.aboutScene()) return toHome();
    const auto [middle, radius] = session_.aboutScene()->bounds();
    frameSphere(panels_.selected ? panels_.selected->place : middle, panels_.selected ? radius / 4 : radius);
}

void Viewer::orbit(double degreesRight, double degreesUp) {
    if (!session_.aboutScene()) return;
    Pose pose = session_.stand.pose;
    const Vec3 arm = pose.eye - pose.target;
    const Vec3 side = normalized(cross(pose.up, arm));
    // Never over the poles of the world's up: the horizon stays level.
    const Vec3 worldUp{0, 1, 0};
    const double elevation =
        std::asin(std::clamp(dot(normalized(arm), worldUp), -1.0, 1.0)) * 180 / std::numbers::pi;
    constexpr double pole = 89;
    const double lift = std::clamp(elevation + degreesUp, -pole, pole) - elevation;
    const Vec3 lifted = Affine::rotation(length(side) > 0 ? side : Vec3{1, 0, 0}, -lift).direction(arm);
    pose.eye = pose.target + Affine::rotation(worldUp, degreesRight).direction(lifted);
    pose.up = worldUp;
    moveTo(pose);
}

void Viewer::pan(double pixelsRight, double pixelsDown) {
    if (!session_.aboutScene()) {
        place_.move(pixelsRight, pixelsDown);
        placed_ = false;
        return;
    }
    Pose pose = session_.stand.pose;
    const Vec3 forward = pose.target - pose.eye;
    const Vec3 side = normalized(cross(forward, pose.up)), up = normalized(cross(side, forward));
    const double perPixel =
        (pose.orthographic ? 1 : length(forward)) / (pose.pixelsPerSlopeOverHeight * session_.stand.height);
    const Vec3 by = side * (-pixelsRight * perPixel) + up * (pixelsDown * perPixel);
    pose.eye = pose.eye + by;
    pose.target = pose.target + by;
    moveTo(pose);
}

void Viewer::dolly(double steps) {
    const double closer = std::pow(0.9, std::clamp(steps, -100.0, 100.0));
    if (!session_.aboutScene()) {
        place_.zoom(1 / closer, pointerX_ * panels_.scale, pointerY_ * panels_.scale);
        placed_ = false;
        return;
    }
    Pose pose = session_.stand.pose;
    if (pose.orthographic)
        pose.pixelsPerSlopeOverHeight /= closer;
    else
        pose.eye = pose.target + (pose.eye - pose.target) * closer;
    moveTo(pose);
}

void Viewer::frameSphere(Vec3 middle, double radius) {
    Pose pose = session_.stand.pose;
    const Vec3 back = normalized(pose.eye - pose.target);
    pose.target = middle;
    if (pose.orthographic) {
        pose.pixelsPerSlopeOverHeight = 0.45 / radius;
        pose.eye = middle + back * (4 * radius);
    } else {
        // The sphere fills the height of the picture, with a little air.
        pose.eye = middle + back * (1.15 * radius * std::hypot(2 * pose.pixelsPerSlopeOverHeight, 1));
    }
    moveTo(pose);
}

void Viewer::fly() {
    flying_ = false;
    if (!session_.aboutScene()) return;
    double ahead = 0, aside = 0, rise = 0;
    const auto axis = [&](int plus, int minus) {
        return (keys_[static_cast<size_t>(plus)] ? 1.0 : 0.0) -
               (keys_[static_cast<size_t>(minus)] ? 1.0 : 0.0);
    };
    ahead = axis('W', 'S') + axis(up, down);
    aside = axis('D', 'A') + axis(right, left);
    rise = axis(pageUp, pageDown);
    if (ahead == 0 && aside == 0 && rise == 0) return;
    if ((modifiers_ & control) != 0) return;
    flying_ = true;
    Pose pose = session_.stand.pose;
    const Vec3 forward = pose.target - pose.eye;
    const double step = 0.02 * length(forward);
    const Vec3 by = (normalized(forward) * ahead + normalized(cross(forward, pose.up)) * aside +
                     normalized(pose.up) * rise) *
                    step;
    pose.eye = pose.eye + by;
    pose.target = pose.target + by;
    moveTo(pose);
}

}  // namespace spectrad::view
