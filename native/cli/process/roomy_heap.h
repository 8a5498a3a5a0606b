// The heap in large pages, where the system has them.
#pragma once

namespace koebe::cli {

/// One heap for all threads, with room in large pages from its start. Of the time of a map a fifth would go to the
/// system otherwise, which hands out memory in pages of 4 kB and takes back what is freed, over and over. Nothing of
/// it is touched before it is used. Where the memory is limited, nothing changes.
/// Before other threads, and not where many work at once: they would wait for one another.
void take_roomy_heap();

}  // namespace koebe::cli
