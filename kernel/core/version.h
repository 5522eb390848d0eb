/// Version of the library, for programs that must compile against several.
#pragma once

#define LISSOM_VERSION_MAJOR 0
#define LISSOM_VERSION_MINOR 2
#define LISSOM_VERSION_PATCH 0

/// "0.2.0"
#define LISSOM_VERSION                                                           \
    LISSOM_VERSION_TEXT_OF(LISSOM_VERSION_MAJOR)                                 \
    "." LISSOM_VERSION_TEXT_OF(LISSOM_VERSION_MINOR) "." LISSOM_VERSION_TEXT_OF( \
        LISSOM_VERSION_PATCH)

/// One number that grows with the version: `#if LISSOM_VERSION_NUMBER >= 10000` is 1.0.0 or later.
#define LISSOM_VERSION_NUMBER \
    (LISSOM_VERSION_MAJOR * 10000 + LISSOM_VERSION_MINOR * 100 + LISSOM_VERSION_PATCH)

#define LISSOM_VERSION_TEXT_OF(number) LISSOM_VERSION_TEXT(number)
#define LISSOM_VERSION_TEXT(number) #number
