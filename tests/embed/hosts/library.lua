-- Calls the shared library at a path by LuaJIT's ffi, as scripts and games do.
local ffi = require "ffi"
ffi.cdef [[
typedef struct { const void* data; size_t size; } lissom_bytes;
int lissom_context_create_abi1(const void* options, void** context);
void lissom_context_destroy(void* context);
int lissom_call(void* context, const char* name, const char* arguments, lissom_bytes* json);
]]

return function(path)
    local library = ffi.load(path)
    local context, json = ffi.new("void*[1]"), ffi.new("lissom_bytes")
    assert(library.lissom_context_create_abi1(nil, context) == 0)
    assert(library.lissom_call(context[0], "shapes.box", "[]", json) == 0)
    local text = ffi.string(json.data, json.size)
    library.lissom_context_destroy(context[0])
    assert(text:find("lissom.Mesh", 1, true), text)
    return "both work"
end
