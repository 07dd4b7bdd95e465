// SPDX-License-Identifier: MIT
// Annotations of the Microsoft source-code annotation language. They tell its analyzer what a
// parameter is, and a compiler nothing.
#pragma once

#define _In_
#define _In_z_
#define _In_opt_
#define _In_opt_z_
#define _Out_
#define _Out_opt_
#define _Inout_
#define _Inout_opt_
#define _Inout_z_
#define _Outptr_
#define _Outptr_opt_
#define _Outptr_result_maybenull_
#define _Outptr_opt_result_maybenull_
#define _Outptr_result_z_
#define _Outptr_opt_result_z_
#define _Outptr_result_nullonfailure_
#define _Outref_
#define _COM_Outptr_
#define _COM_Outptr_opt_
#define _COM_Outptr_result_maybenull_
#define _COM_Outptr_opt_result_maybenull_
#define _Ret_maybenull_
#define _Ret_notnull_
#define _Ret_z_
#define _Ret_opt_
#define _Check_return_
#define _Must_inspect_result_
#define _Maybenull_
#define _Notnull_
#define _Null_terminated_
#define _Pre_notnull_
#define _Pre_maybenull_
#define _Post_notnull_
#define _Printf_format_string_
#define _Use_decl_annotations_
#define _Reserved_
#define _Field_z_
#define _In_reads_z_
#define _Frees_ptr_
#define _Frees_ptr_opt_
#define _Analysis_noreturn_
#define _Deref_out_
#define _Deref_out_opt_
#define _Enum_is_bitflag_
#define _In_reads_(a)
#define _In_reads_opt_(a)
#define _In_reads_bytes_(a)
#define _In_reads_bytes_opt_(a)
#define _In_count_(a)
#define _In_opt_count_(a)
#define _In_bytecount_(a)
#define _In_reads_or_z_(a)
#define _Out_writes_(a)
#define _Out_writes_opt_(a)
#define _Out_writes_z_(a)
#define _Out_writes_opt_z_(a)
#define _Out_writes_bytes_(a)
#define _Out_writes_bytes_opt_(a)
#define _Out_writes_all_(a)
#define _Out_writes_all_opt_(a)
#define _Out_writes_bytes_all_(a)
#define _Out_writes_bytes_all_opt_(a)
#define _Out_cap_(a)
#define _Out_bytecap_(a)
#define _Inout_updates_(a)
#define _Inout_updates_opt_(a)
#define _Inout_updates_bytes_(a)
#define _Inout_updates_bytes_opt_(a)
#define _Inout_updates_all_(a)
#define _Outptr_result_buffer_(a)
#define _Outptr_opt_result_buffer_(a)
#define _Outptr_result_bytebuffer_(a)
#define _Outptr_opt_result_bytebuffer_(a)
#define _Field_size_(a)
#define _Field_size_opt_(a)
#define _Field_size_bytes_(a)
#define _Field_size_bytes_opt_(a)
#define _Field_size_full_(a)
#define _Field_size_full_opt_(a)
#define _Field_size_bytes_full_(a)
#define _Field_size_bytes_full_opt_(a)
#define _Success_(a)
#define _Return_type_success_(a)
#define _Always_(a)
#define _Inexpressible_(a)
#define _Analysis_assume_(a)
#define __analysis_assume(a)
#define _Pre_satisfies_(a)
#define _Post_satisfies_(a)
#define _IRQL_requires_(a)
#define _IRQL_requires_min_(a)
#define _IRQL_requires_max_(a)
#define _Guarded_by_(a)
#define _Acquires_lock_(a)
#define _Releases_lock_(a)
#define _Requires_lock_held_(a)
#define _In_range_(a, b)
#define _Out_range_(a, b)
#define _Field_range_(a, b)
#define _Ret_range_(a, b)
#define _Deref_out_range_(a, b)
#define _Out_writes_to_(a, b)
#define _Out_writes_to_opt_(a, b)
#define _Out_writes_bytes_to_(a, b)
#define _Out_writes_bytes_to_opt_(a, b)
#define _Inout_updates_to_(a, b)
#define _Field_size_part_(a, b)
#define _Field_size_bytes_part_(a, b)
#define _At_(a, b)
#define _When_(a, b)
#define _Outptr_result_buffer_to_(a, b)
#define _At_buffer_(a, b, c, d)
