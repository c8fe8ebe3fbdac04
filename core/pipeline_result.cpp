#include "pipeline.h"

namespace dualblock {

template <int N> PipelineResult<N>::PipelineResult() = default;
template <int N> PipelineResult<N>::PipelineResult(const PipelineResult &) = default;
template <int N> PipelineResult<N>::PipelineResult(PipelineResult &&) noexcept = default;
template <int N> PipelineResult<N> &PipelineResult<N>::operator=(const PipelineResult &) = default;
template <int N> PipelineResult<N> &PipelineResult<N>::operator=(PipelineResult &&) noexcept = default;
template <int N> PipelineResult<N>::~PipelineResult() = default;

template struct PipelineResult<2>;
template struct PipelineResult<3>;

} // namespace dualblock
