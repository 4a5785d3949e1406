// A job: commands that fill one folder, done at most once whoever asks for it. Lines of `tilth job FOLDER` may be run
// by any engine, on any machine that sees the folder; a job that is killed is done again, one that is done is not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tilth::app {

using Command = std::vector<std::string>;  ///< program and arguments; the program "tilth" is this one

/// Scans that jobs share: made by the first of them that needs them, where they are to be made at all.
struct Recording {
  std::filesystem::path folder;  ///< of the scans, or the file; absolute
  Command make;                  ///< fills the folder; empty: it stands as it is
  std::string program;           ///< that makes it
};

struct Job {
  std::filesystem::path folder;  ///< of the results; absolute
  Recording recording;
  std::vector<Command> commands;
  std::string program;  ///< version and fingerprint of what runs: another program, another job
};

struct JobEnd {
  bool done = false;    ///< it was brought to an end
  std::string failure;  ///< empty, or what went wrong
};

/// A number that tells the bytes of a file from others, in hexadecimal digits. Throws Error where it cannot be read.
std::string fingerprint(const std::filesystem::path& file);

/// Version and fingerprint of this program.
const std::string& own_name();

/// Writes job.json into the folder of the job, which is made. Throws Error where that cannot be.
void write_job(const Job& job);

/// Reads job.json from `folder`. Throws Error naming the file where it is missing or no job.
Job read_job(const std::filesystem::path& folder);

/// How the job in its folder ended; not done where it never ran to its end, was killed, or was another job.
JobEnd end_of(const Job& job);

/// Does the job unless it is done; waits where another process is at it. Interrupted, it leaves the job undone. Throws
/// Error where files cannot be written.
JobEnd perform(const Job& job);

/// Removes the scans of a recording that jobs have made; truth, times and recipe stay.
void remove_scans(const Recording& recording);

}  // namespace tilth::app
