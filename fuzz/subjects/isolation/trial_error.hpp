// Errors that are not a plug-in's fault, and that end its trial.
#pragma once

#include "ccd/query/error.hpp"

namespace nearmiss::isolation {

/// No more answers can be collected, for a reason that is no fault of the plug-in's code.
class TrialError : public Error {
 public:
  using Error::Error;
};

/// The system does not start a worker process, for example because the user has too many processes.
class NoWorker : public TrialError {
 public:
  using TrialError::TrialError;
};

}  // namespace nearmiss::isolation
