// What of a session outlives the opening of other files.
#pragma once

#include "spectrum/resolver.h"
#include "viewer/subject.h"

namespace spectrad::view {

/// A look at `before` as one at `fresh`: what was changed stays where the files say of it what they said
/// before.
[[nodiscard]] Look carried(const Look& old, const Subject& before, const Subject& fresh,
                           const SpectrumResolver& resolver);
/// The same of how it is looked at: another camera in the file is seen through, another size of the window is
/// not.
[[nodiscard]] Stand carried(const Stand& old, const Subject& before, const Subject& fresh);

}  // namespace spectrad::view
