// SPDX-License-Identifier: Apache-2.0
/// \file
/// Includes the public headers. Only the public headers and the headers that they include are
/// installed; all other headers may change without notice.
#pragma once

#include "crowdface/blend/blend.h"
#include "crowdface/blend/recipe.h"
#include "crowdface/cast/compared_area.h"
#include "crowdface/config/config.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/core/cancel.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/units.h"
#include "crowdface/core/version.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/run/generate.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/smoothing_operator.h"
