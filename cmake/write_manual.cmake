# Writes the manual page and the shell completions, which the program prints, into FOLDER.
#   cmake -D PROGRAM=… -D FOLDER=… -P write_manual.cmake
function(write file)
  get_filename_component(folder ${FOLDER}/${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
write(man/man1/crowdface.1 manual)
write(bash-completion/completions/crowdface completion bash)
write(zsh/site-functions/_crowdface completion zsh)
write(fish/vendor_completions.d/crowdface.fish completion fish)
