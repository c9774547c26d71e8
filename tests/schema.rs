//! The JSON Schema as editors get it.

#[test]
fn the_schema_is_as_recorded() {
    insta::assert_json_snapshot!(lenspeel::cli::schema());
}
