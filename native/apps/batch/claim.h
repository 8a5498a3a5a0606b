// Claims on files, so that several runs share one output folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace koebe::batch {

/// A claim is a file FOLDER/KEY.GENERATION. Its creation fails if the file exists; file systems keep this atomic even
/// over a network. The highest generation counts. To take over a dead claim, a run creates the next generation. So only
/// one of several runs succeeds, and no run removes a live claim.
///
/// A claim names its host and process. It is dead if its process has left this host. On another host it is dead if its
/// time of change has stood still too long, as its owner renews it every few seconds (beat). The observer's clock
/// measures that, as the clocks of hosts differ.
class Claims {
public:
    static constexpr unsigned beat_ms = 10000;  ///< the owner renews a claim at this interval

    /// @param stale seconds without a beat after which another host's claim is dead
    Claims(std::filesystem::path folder, double stale);

    class Claim {
    public:
        /// The claim's folder for unfinished files. It is removed with the claim.
        const std::filesystem::path& work() const { return work_; }
        const std::string& key() const { return key_; }
        const std::string& word() const { return word_; }  ///< KEY.GENERATION
        void beat() const noexcept;
        /// False once another run has taken over, for example because this process had been stopped.
        bool is_held() const;
        void release() noexcept;

    private:
        friend class Claims;
        std::filesystem::path file_, work_;
        std::string key_, word_;
        long generation_ = 0;
        bool is_released_ = false;
    };

    /// Takes the claim on a name, unless another run holds it. Check after this, not only before, whether the file is
    /// done: it may have been done in between.
    /// @throws FileError the folder cannot be written
    std::optional<Claim> take(const std::string& name);

    /// Takes the claim once the other run has released it or is dead.
    Claim wait(const std::string& name);

    /// Removes the files of dead runs, and the folder if no run has a claim in it.
    void clean_up() noexcept;

private:
    struct Watch {
        long generation;
        std::string state;  ///< time of its last change
        std::chrono::steady_clock::time_point since;
    };

    std::optional<Claim> take_key(const std::string& key, const std::string& name);
    /// Takes over and releases claims of dead runs on files that are done.
    void release_dead();
    long highest(const std::string& key) const;
    bool is_dead(const std::string& key, long generation);

    std::filesystem::path folder_;
    double stale_;
    std::string host_;
    std::map<std::string, Watch> watched_;
};

}  // namespace koebe::batch
