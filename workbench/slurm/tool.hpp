#pragma once
// The programs of Slurm: asked, and what they answer.

#include <string>
#include <vector>

namespace beadwork::slurm {

struct Answer {
  int code = -1;  ///< 127: there is no such program
  std::string out, error;
};

/// Runs a program to its end. It hears nothing of the job that this process may itself stand in, so that what it submits
/// or asks for is the same inside and outside of one; nor of Ctrl-C: what has begun to be submitted is submitted.
/// `kept`: a descriptor that it holds open as long as it lives; -1 for none.
Answer ask(const std::vector<std::string>& command, const std::string& input = "", int kept = -1);

/// Whether a variable of the environment comes of a job of Slurm, or changes what its programs do; "NAME=value".
bool is_of_slurm(const std::string& variable);

}  // namespace beadwork::slurm
