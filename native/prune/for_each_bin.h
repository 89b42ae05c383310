// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <type_traits>

#include "base/parallel.h"
#include "links/link_set.h"

namespace antiradiance {

// Calls judge(worker, bin) for every bin of a link set on all cores. Workers hold a bin's tables:
// make() gives each thread one, which is used again for its next bin.
template <typename Make, typename Judge>
void for_each_bin(const LinkSet& links, Progress& progress, const Make& make, const Judge& judge) {
    tbb::enumerable_thread_specific<std::invoke_result_t<Make>> workers(make);
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress,
                 [&](std::size_t bin) { judge(workers.local(), static_cast<int>(bin)); });
}

}  // namespace antiradiance
