// Which of several runs on one output folder has a file in hand.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace koebe::batch {

/// Claims are files FOLDER/KEY.GENERATION, made by a create that fails where the file is, which file systems keep
/// atomic over a network too. The highest generation holds. To take over a dead one is to create the next, so that of
/// several that try one succeeds, and nobody removes a claim that is alive.
///
/// A claim names its host and process. It is dead if the process is gone from this host, or if its time of change has
/// stood still for so long that its owner, who renews it every few seconds (beat), is gone from another one. That is
/// measured by the clock of who looks on, as the clocks of hosts differ.
class Claims {
public:
    /// @param stale seconds without a beat after which a claim of another host is dead
    Claims(std::filesystem::path folder, double stale);

    class Claim {
    public:
        /// A folder of the claim's own for what is not whole yet. It is removed with the claim.
        const std::filesystem::path& work() const { return work_; }
        const std::string& key() const { return key_; }
        const std::string& word() const { return word_; }  ///< KEY.GENERATION
        void beat() const noexcept;
        /// False once another run has taken over, as after this process had stood still.
        bool is_held() const;
        void release() noexcept;

    private:
        friend class Claims;
        std::filesystem::path file_, work_;
        std::string key_, word_;
        long generation_ = 0;
        bool is_released_ = false;
    };

    /// The claim on a name, unless another run holds it. Whether the file is done has to be asked after this, not only
    /// before: it may have been in between.
    /// @throws FileError the folder cannot be written
    std::optional<Claim> take(const std::string& name);

    /// The same, once the other run has released it or is dead.
    Claim wait(const std::string& name);

    /// Removes what dead runs have left, and the folder if no run has a claim in it.
    void clean_up() noexcept;

private:
    struct Watch {
        long generation;
        std::string state;  ///< the time of its last change
        std::chrono::steady_clock::time_point since;
    };

    std::optional<Claim> take_key(const std::string& key, const std::string& name);
    /// Takes over, and releases, the claims of dead runs: those of files that were done, but for that.
    void release_dead();
    long highest(const std::string& key) const;
    bool is_dead(const std::string& key, long generation);

    std::filesystem::path folder_;
    double stale_;
    std::string host_;
    std::map<std::string, Watch> watched_;
};

}  // namespace koebe::batch
