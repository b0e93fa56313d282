// Textures as the kernels read them: placed, wrapped, with their pyramids.
#pragma once

#include "render/texture.h"
#include "render/world.h"

namespace spectrad {

/// An image of half the size (at least one texel a side): each texel the mean of the area it covers.
[[nodiscard]] Texels halved(const Texels& image);

/// Appends an image to the world's textures, with all smaller levels where the use is filtered by them;
/// returns 1
/// + its number.
[[nodiscard]] std::uint32_t addTexels(World& world, Texels image, const TextureUse& use);

/// The same for an image that stays on the device, which has its smaller levels where the use is filtered by
/// them.
[[nodiscard]] std::uint32_t addResident(World& world, std::shared_ptr<const ResidentTexels> image,
                                        const TextureUse& use);

/// The image of a texture that stays on the device, null of one that does not. `number`: 1 + its number.
[[nodiscard]] const ResidentTexels* residentOf(const World& world, std::uint32_t number);
/// A texture's finest level on the host. Throws MachineError.
[[nodiscard]] std::vector<float> finestLevel(const World& world, std::uint32_t number);
/// The largest value of an image of values that are not below zero; 0 of one that was not loaded. Throws
/// MachineError.
[[nodiscard]] float largestTexel(const World& world, std::uint32_t number);

/// Brings the texels of passes that stayed on the device to the host, for who reads a world there. Throws
/// MachineError.
void fetchTexels(World& world);

/// Kernel switches that the world's textures need.
[[nodiscard]] std::vector<std::string> textureDefines(const World& world);

}  // namespace spectrad
