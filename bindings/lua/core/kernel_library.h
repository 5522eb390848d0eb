/// The parts of the library of the kernel; private to bindings/lua. Each file of the folders beside
/// this one describes its functions and types by one of these.
#pragma once

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

Type mesh_type();
std::vector<Function> mesh_functions();
std::vector<Function> mesh_edit_methods();
std::vector<Function> mesh_query_methods();
std::vector<Function> mesh_file_functions();
std::vector<Function> mesh_file_methods();
std::vector<Function> mesh_report_methods();

Type region_type();
std::vector<Function> region_methods_of_mesh();

Type path_type();
std::vector<Function> path_methods_of_mesh();

std::vector<Function> parameterize_methods_of_mesh();
std::vector<Record> parameterize_records();

std::vector<Function> cut_methods_of_mesh();
std::vector<Function> trim_methods_of_path();
std::vector<Record> cut_records();

Type buffer_type();
std::vector<Function> buffer_methods_of_mesh();

Type deformer_type();
std::vector<Function> deform_engine_methods();
Type handle_type();
Type bones_type();
std::vector<Function> deform_functions();

Type merger_type();
Type provenance_type();
Type paste_type();
std::vector<Function> merge_functions();
std::vector<Function> paste_functions();
std::vector<Record> merge_records();
std::vector<Function> erase_methods_of_mesh();
std::vector<Record> paste_records();
std::vector<Record> erase_records();
std::vector<Function> scatter_functions();
std::vector<Record> scatter_records();
std::vector<Function> part_functions();
std::vector<Record> part_records();

std::vector<Function> shape_functions();

Type scalp_type();
std::vector<Function> scalp_functions();
Type curve_type();
std::vector<Record> curve_records();
Type hairstyle_type();
std::vector<Function> hairstyle_functions();
std::vector<Record> hairstyle_records();
Function style_text_method();
Function read_style_function();
std::vector<Function> groom_functions();
std::vector<Record> groom_records();

Type strands_type();
std::vector<Function> strand_functions();
std::vector<Record> strand_records();

Type scene_type();
std::vector<Function> scene_functions();
std::vector<Record> scene_records();
Type polyline_type();
std::vector<Function> polyline_functions();

Type camera_type();
std::vector<Function> camera_functions();
std::vector<Function> pick_methods_of_camera();
Function select_method_of_camera();
Function stroke_method_of_camera();
std::vector<Record> stroke_records();
Type support_type();
std::vector<Function> support_methods_of_curve();
std::vector<Record> support_records();
std::vector<Record> pick_records();
Type gizmo_type();
Type tool_view_type();
std::vector<Function> gizmo_functions();
std::vector<Record> gizmo_records();

Function sketch_method_of_hairstyle();
std::vector<Record> sketch_records();
std::vector<Function> tool_functions();
std::vector<Record> tool_records();

Type parameters_type();
std::vector<Function> parameter_functions();

/// lissom.try and lissom.error
std::vector<Function> error_functions();
std::vector<Record> error_records();

/// The tables that functions return.
std::vector<Record> kernel_records();

/// Option tables shared by several functions: {axis=, angle=, about=}.
std::vector<Parameter> rotation_fields(const std::string& about_default);

}  // namespace lissom::lua
