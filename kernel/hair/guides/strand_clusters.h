/// Clusters: strands that are alike in place and shape, as one guide or one card stands for them.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Strands that stay together in a cluster.
enum class ClusterUnit {
    strand,  ///< nothing: each strand on its own
    lock,    ///< strands of one guide (Strands::guides), as those of a curl
    /// Nothing, as for `strand`, but strands of several guides share no cluster, as those of
    /// several groups.
    within_lock,
};

struct ClusterOptions {
    /// Number of clusters over all groups, at least 1; each group has one at least, and no more
    /// than it has units.
    Index count = 200;
    ClusterUnit unit = ClusterUnit::strand;
    /// Weight of the difference of two strands' shapes against the distance of their roots; 0 or
    /// more. Strands on both sides of a parting differ in shape.
    double shape = 1.0;
    /// Rounds of improvement; at least 0.
    int rounds = 8;
};

struct StrandClusters {
    /// Cluster of each strand; kNoIndex for strands without length.
    std::vector<Index> of_strand;
    /// For each cluster the strand with the least sum of squared distances to the others; the one
    /// of the lowest number among equals.
    std::vector<Index> medoids;
};

/// Clusters strands by k-medoids. The square of the distance of two strands is that of their roots,
/// plus `shape` times the mean of those between their points at a third, two thirds and the whole
/// of their length, as seen from their roots. For squares the medoid of a cluster is the strand
/// nearest to its mean, so the rounds are those of Lloyd 1982. The first clusters are those of the
/// strands of the lowest ids, which are spread over the scalp. Strands of several groups share no
/// cluster. The same for any number of threads. Errors: invalid_argument for options out of range,
/// or if no strand has a length; not_finite naming strands; cancelled.
StrandClusters cluster_strands(const Strands& strands, const ClusterOptions& options = {},
                               const Context& context = {});

}  // namespace lissom
