// What observers were told when they began, kept in checkpoints beside what they have summed up.
//
// Observers may come, go and change between the parts of a run. One that goes on with sums of an earlier part may not: with other
// settings its tables would add up what does not belong together.
#pragma once

#include "scree/simulation/part.hpp"

namespace scree {

class Plugin;
class StateReader;
class StateWriter;

/// Saves `observer`, and its settings when it had something to save.
void save_observer(const Options& options, const Plugin& observer, StateWriter& out);

/// Refuses settings other than those that `in`, the group of the same observer, was saved with. Groups without settings, of
/// observers that keep nothing, go with any. @throws Error (usage) at the setting.
void check_kept_options(const PartInfo& info, const Options& options, const StateReader& in);

}  // namespace scree
