%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
! rule: a header between two %%% lines
! source: [code] 56 public files
MODULE Demo
ENDMODULE
